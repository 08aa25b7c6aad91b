// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/kinetic/kinetic_edges.hpp>

#include "base/tournament.hpp"

namespace dch::kinetic {

/// What is next for a point. Ordered by time, then by ids, so that the order never depends on a history.
struct Due {
  double time;
  Edge edge;  ///< {point, -1} where no other point has part in it
  std::int32_t pair = -1;

  bool operator<(const Due& other) const {
    return time != other.time ? time < other.time : edge < other.edge;
  }
};

/// One entry for each point, the earliest on top.
class PointQueue : public detail::Tournament<Due> {
 public:
  explicit PointQueue(std::size_t points) : Tournament(nothing_due(points)) {}

 private:
  static std::vector<Due> nothing_due(std::size_t points) {
    std::vector<Due> entries;
    for (std::size_t i = 0; i < points; ++i) entries.push_back({kNever, {static_cast<std::int32_t>(i), -1}});
    return entries;
  }
};

}  // namespace dch::kinetic
