// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/proximity/nearest.hpp>

#include "near_leaves.hpp"
#include "nearest_descent.hpp"
#include "simd/nearest_kernels.hpp"

namespace dch::detail {

/// The nearest neighbors of all points of a leaf at once: the blocks near it are put side by side in float,
/// and what may be among the nearest is measured once more as it should be. Points that have fewer than k
/// others near their leaf ask by descent.
template <class Metric>
class LeafNearest {
 public:
  LeafNearest(const Metric& metric, const Structure& structure, const SubtreeBalls& balls, std::int32_t k);

  /// Fills the rows of a leaf's points.
  void search_leaf(std::int32_t leaf, NearestRows& rows);
  /// Fills the row of a point by descent.
  void search_point(std::int32_t id, NearestRows& rows);

  NearestWork work() const;

 private:
  double guess_reach(std::int32_t leaf) const;
  bool fits(double reach) const;
  bool has_one_image(double distance) const;
  double error() const;
  double blur() const;
  double limit2(double reach) const;
  void search_block(std::int32_t block, double reach, NearestRows& rows);
  void select(std::int32_t block, double reach);
  void sort_by_gap(std::int32_t count);
  bool find(std::int32_t slot, double reach);
  bool shrink(NearestTask& task);
  float least_found() const;
  float last_found();
  void fetch(std::int32_t slot, const NearestRows& rows) const;
  bool settle(std::int32_t slot, std::int32_t first, std::int32_t last, double reach, NearestRows& rows);
  double distance2(std::int32_t slot, std::int32_t other) const;
  void write_row(std::int32_t id, NearestRows& rows) const;

  const Structure& structure_;
  const SubtreeBalls& balls_;
  std::int32_t k_;
  double slack_;  ///< by which distances of wrapped points may be off
  NearLeaves near_;
  NearestDescent<Metric> descent_;
  const Metric& metric_;
  const NearestKernels& kernels_;
  NearestCandidates best_;
  NearestWork work_;

  // Of the block whose points ask: the blocks near it, and their points
  struct Selected {
    float gap2;
    std::int32_t block;
  };
  std::vector<Selected> by_gap_;
  std::vector<std::int32_t> block_;
  std::vector<float> gap2_;
  std::vector<float> coordinates_[3];
  std::vector<std::int32_t> slots_;
  NearPoints points_{};
  std::int32_t point_count_ = 0;
  std::vector<std::int32_t> candidates_;  ///< slots of what may be among the nearest of its points

  // Of one of them
  struct Buffer {
    std::vector<float> distance2;
    std::vector<std::int32_t> slot;
  };
  Buffer buffers_[2];
  NearestFound found_{}, sorted_{};
  std::vector<std::int32_t> order_;
};

}  // namespace dch::detail
