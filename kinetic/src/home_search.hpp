// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/kinetic/kinetic_edges.hpp>
#include <dch/lists/list_maker.hpp>

namespace dch::kinetic {

/// A kept hierarchy over the homes of points, as they were when all of them were given one.
class HomeSearch {
 public:
  /// @param largest distance of a pair
  /// @param room that is added to the distance of every pair in a search
  HomeSearch(const KineticParams& params, double largest, double room);

  /// Takes the homes of all points. Returns the pairs within their distance and the room, as a half list.
  const NeighborList& find_all(Span<const Vec3> homes);

  /// Calls f for the points whose homes then were within `reach` of a position. A descent of the hierarchy.
  void find_near(Vec3 position, double reach, const std::function<void(std::int32_t)>& f);

 private:
  const KineticParams& params_;
  ListParams request_;
  Hierarchy hierarchy_;
  bool is_built_ = false;
  ListMaker maker_;
  NeighborList list_;
};

}  // namespace dch::kinetic
