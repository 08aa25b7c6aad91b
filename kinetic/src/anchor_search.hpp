// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/geometry/box.hpp>
#include <dch/hierarchy/hierarchy.hpp>

#include "simd/sphere_kernels.hpp"

namespace dch::kinetic {

/// Which of many balls touch one: a hierarchy over the centers for each octave of radii. Balls that have
/// changed since the hierarchies were made are looked at one by one. And all balls that touch, by one list.
class AnchorSearch {
 public:
  AnchorSearch(const Box& box, const SphereKernels& kernels, const NearestImages& nearest)
      : box_(box), kernels_(kernels), nearest_(nearest) {}

  const Ball& ball(std::int32_t id) const { return balls_[static_cast<std::size_t>(id)]; }
  void set_all(const std::vector<Ball>& balls);
  void set(std::int32_t id, const Ball& ball);
  /// Whether so many balls have been set one by one that it pays to set all, or at least to refresh().
  bool has_many_strays() const { return strays_.size() >= most_strays(); }
  /// Has the hierarchies hold the balls as they are.
  void refresh();
  /// No ball may be wider in a list of all that touch.
  double widest_to_list() const;
  /// The pairs of balls that touch, as a half list.
  const NeighborList& find_all_touching();
  /// Writes the other balls that touch that of `id`, in no order that counts.
  void find_touching(std::int32_t id, std::vector<std::int32_t>& touching);

 private:
  struct Octave {
    std::vector<std::int32_t> ids, ids_before;
    std::vector<Vec3> centers;
    double largest = 0;  ///< radius of a ball
    Hierarchy hierarchy;
    std::optional<HierarchyView> view;
  };

  std::size_t most_strays() const;
  Octave& octave(int exponent);
  int keep_or_choose_octave(std::size_t id);

  Box box_;
  const SphereKernels& kernels_;
  const NearestImages& nearest_;
  std::vector<Ball> balls_;
  std::vector<int> octave_of_;
  std::map<int, Octave> octaves_;
  std::vector<std::int32_t> strays_;  ///< whose balls have changed
  std::vector<char> is_stray_;
  std::vector<std::int32_t> near_;      ///< that may touch a ball
  std::unique_ptr<PairSearch> search_;  ///< of all pairs
  double search_radius_ = 0;            ///< of its longest lists
  NeighborList touching_;
};

}  // namespace dch::kinetic
