// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <dch/geometry/box.hpp>
#include <dch/hierarchy/hierarchy.hpp>

namespace dch::kinetic {

struct Ball {
  Vec3 center{};
  double radius = 0;
};

/// Which of many balls touch one: a hierarchy over the centers for each octave of radii. Balls that have
/// changed since the hierarchies were made are looked at one by one, until they are too many.
class AnchorSearch {
 public:
  explicit AnchorSearch(const Box& box) : box_(box) {}

  const Ball& ball(std::int32_t id) const { return balls_[static_cast<std::size_t>(id)]; }
  void set_all(const std::vector<Ball>& balls);
  void set(std::int32_t id, const Ball& ball);
  /// Writes the other balls that touch that of `id`, in no order that counts.
  void find_touching(std::int32_t id, std::vector<std::int32_t>& touching) const;
  bool touch(std::int32_t a, std::int32_t b) const {
    const double reach = ball(a).radius + ball(b).radius;
    return box_.distance2(ball(a).center, ball(b).center) <= reach * reach;
  }

 private:
  struct Octave {
    std::vector<std::int32_t> ids, ids_before;
    std::vector<Vec3> centers;
    double largest = 0;  ///< radius of a ball
    Hierarchy hierarchy;
    std::optional<HierarchyView> view;
  };

  void refresh();
  Octave& octave_of(double radius);

  Box box_;
  std::vector<Ball> balls_;
  std::map<int, Octave> octaves_;
  std::vector<std::int32_t> strays_;  ///< whose balls have changed
  std::vector<char> is_stray_;
};

}  // namespace dch::kinetic
