// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>

#include "scenes.hpp"

namespace dch {

/// A hierarchy in which nothing is chosen by hand, and which changes from one step to the next: points move,
/// and a repair may be put off; then some come and go.
class ProximityScene {
 public:
  ProximityScene(std::uint64_t seed, std::size_t most_points, std::size_t least_points = 0)
      : random(seed), hierarchy_(choose(least_points, most_points)) {
    what_ = "seed " + std::to_string(seed) + ": " + what_;
    hierarchy_.build(points_, box_.box);
  }

  /// In some scenes one that the hierarchy keeps up.
  HierarchyView view() { return keeps_ ? kept_view() : measured_view(); }
  HierarchyView kept_view() { return hierarchy_.kept_view(); }
  HierarchyView measured_view() { return hierarchy_.view(); }
  const Box& box() const { return box_.box; }
  double radius() const { return hierarchy_.params().radius; }
  const std::string& what() const { return what_; }
  /// Somewhere in the cell or near it.
  Vec3 somewhere() { return scenes::from_fractional(box_.box, random.in_cube(2)); }
  std::vector<std::int32_t> ids() {
    std::vector<std::int32_t> all;
    for (std::int32_t id = 0; id < static_cast<std::int32_t>(hierarchy_.capacity()); ++id)
      if (hierarchy_.contains(id)) all.push_back(id);
    return all;
  }

  void change(int step) {
    if (step % 2 == 0) {
      move();
    } else {
      exchange();
    }
  }

  void move() { move(radius() * std::pow(10, random.uniform(-3, 0.3))); }
  /// @param motion of each point along each axis at most
  void move(double motion) {
    for (Vec3& p : points_) p = p + random.in_cube(motion);
    hierarchy_.update(points_, box_.box);
  }
  void exchange() {
    for (std::size_t k = random.below(20); k > 0; --k) exchange_one();
  }
  /// A point comes or goes.
  void exchange_one() {
    const auto id = static_cast<std::int32_t>(random.below(hierarchy_.capacity() + 1));
    if (hierarchy_.contains(id)) {
      hierarchy_.remove(id);
    } else {
      const Vec3 at =
          scenes::from_fractional(box_.box, {random.uniform(), random.uniform(), random.uniform(0, 1.5)});
      const auto got = static_cast<std::size_t>(hierarchy_.insert(at));
      points_.resize(std::max(points_.size(), got + 1));
      points_[got] = at;
    }
  }
  const SearchStats& stats() const { return hierarchy_.stats(); }

  scenes::Random random;

 private:
  HierarchyParams choose(std::size_t least_points, std::size_t most_points) {
    const auto boxes = scenes::all_boxes(random.uniform(3, 12));
    box_ = boxes[random.below(boxes.size())];
    HierarchyParams params;
    const double widest = std::min(3.0, 0.98 * box_.box.max_cutoff());
    params.radius = widest * std::pow(10, -random.uniform());
    params.policy = random.below(2) == 0 ? MaintenancePolicy::automatic : MaintenancePolicy::always_repair;
    const auto sets = scenes::hard_point_sets(
        box_.box, least_points + random.below(most_points - least_points + 1), 0.4 * params.radius + 0.05);
    const scenes::NamedPoints& set = sets[random.below(sets.size())];
    points_ = set.points;
    keeps_ = random.below(3) == 0;
    what_ = std::to_string(points_.size()) + " points, " + set.name + ", " + box_.name + ", radius " +
            std::to_string(params.radius);
    return params;
  }

  scenes::NamedBox box_;
  std::vector<Vec3> points_;
  std::string what_;
  bool keeps_ = false;
  Hierarchy hierarchy_;  // last: it is made by what the others are chosen for
};

}  // namespace dch
