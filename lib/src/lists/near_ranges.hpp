// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/geometry/box.hpp>

#include "leaves/leaf_source.hpp"

namespace dch::detail {

/// A hierarchy whose points may be in the rows of a leaf.
struct NearSource {
  const LeafSource* source;
  double reach;            ///< largest list radius of its points with those of the rows [length]
  std::int16_t box_limit;  ///< see ListKernels::collect
  bool one_image;          ///< whether only the nearest image of a leaf can matter to another one
};

/// The blocks of leaves near a leaf, as ranges that ListKernels take.
template <class Metric>
class NearRanges {
 public:
  using Leaf = MeasuredLeaves::Leaf;

  /// @param rows the hierarchy of leaf k
  NearRanges(const Metric& metric, const Box& box, const LeafSource& rows, std::int32_t k,
             std::vector<BlockRange>& ranges)
      : metric_(metric),
        box_(box),
        rows_(rows),
        k_(k),
        own_(rows.measured().leaves[k]),
        own_owned_(rows.labelled.leaf_owned[k] != 0),
        center_(rows.centers().position[k]),
        ranges_(ranges) {}

  /// Leaves of the same hierarchy, each pair once: in the turn of the one that comes first. A leaf meets
  /// itself once, first of all, and in each of half of its images.
  void find_own(const NearSource& near);
  /// Leaves of another hierarchy. Returns how many of its nodes were looked at.
  std::int64_t find_others(const NearSource& near);

 private:
  static constexpr std::size_t kAtATime = 64;  ///< edges
  double limit_with(const NearSource& near, const Leaf& other) const;
  void add_joined(const NearSource& near, const std::int32_t* joined, std::size_t count);
  void add_images(const NearSource& near, std::int32_t other);
  void add_if_near(const NearSource& near, std::int32_t other, Vec3 between);
  void add(const LeafSource& leaves, std::int32_t other, Vec3 between);

  const Metric& metric_;
  const Box& box_;
  const LeafSource& rows_;
  std::int32_t k_;
  const Leaf& own_;
  bool own_owned_;  ///< whether a point of it is not a ghost
  Vec3 center_;
  std::vector<BlockRange>& ranges_;
};

}  // namespace dch::detail
