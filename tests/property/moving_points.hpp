// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>

#include "scenes.hpp"

namespace dch {

inline std::vector<std::int32_t> ids_of(const HierarchyView& view) {
  std::vector<std::int32_t> ids;
  for (std::int32_t id = 0; id < static_cast<std::int32_t>(view.capacity()); ++id)
    if (view.contains(id)) ids.push_back(id);
  return ids;
}

/// Points in a box that go and come elsewhere, or move.
struct MovingPoints {
  MovingPoints(std::size_t points, const Box& in, std::uint64_t seed) : random(seed), box(in) {
    for (std::size_t k = 0; k < points; ++k) positions.push_back(somewhere());
    HierarchyParams params;
    params.radius = std::min(1.5, 0.9 * box.max_cutoff());
    hierarchy.emplace(params);
    hierarchy->build(positions, box);
  }
  Vec3 somewhere() {
    const Vec3 part{random.uniform(), random.uniform(), random.uniform()};
    if (box.kind() == Box::Kind::none) return side * part;
    return scenes::from_fractional(box, part);
  }
  /// A point in the place of another one, under its id.
  std::int32_t replace(Vec3 by) {
    const auto id = static_cast<std::int32_t>(random.below(positions.size()));
    hierarchy->remove(id);
    EXPECT_EQ(hierarchy->insert(by), id);
    positions[static_cast<std::size_t>(id)] = by;
    return id;
  }
  std::vector<std::int32_t> exchange(std::size_t points) {
    std::vector<std::int32_t> changed;
    for (std::size_t k = 0; k < points; ++k) changed.push_back(replace(somewhere()));
    return changed;
  }
  void shake(double motion) {
    for (Vec3& p : positions) p = p + random.in_cube(motion);
    hierarchy->update(positions, box);
  }

  scenes::Random random;
  Box box;
  double side = 10;
  std::vector<Vec3> positions;
  std::optional<Hierarchy> hierarchy;
};

}  // namespace dch
