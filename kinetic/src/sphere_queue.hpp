// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/kinetic/flight_plan.hpp>

#include "base/tournament.hpp"

namespace dch::kinetic {

/// What is next for a sphere, in as few bytes as it takes: each collision looks at the entries of all
/// partners.
struct SphereEvent {
  double time = kNever;
  std::int32_t partner = -1;  ///< -1 where the sphere leaves its home
  bool is_doubtful = false;   ///< whether nothing happens to the sphere before the time, nor then

  /// The order among spheres, in which the tournament has the smaller id first where times are equal.
  bool operator<(const SphereEvent& other) const { return time < other.time; }
  /// The order among events of one sphere, so that which is next never depends on a history.
  bool is_before(const SphereEvent& other) const {
    return time != other.time ? time < other.time : partner < other.partner;
  }
};

/// One entry for each sphere, the earliest on top.
class SphereQueue : public detail::Tournament<SphereEvent> {
 public:
  explicit SphereQueue(std::size_t spheres) : Tournament(std::vector<SphereEvent>(spheres)) {}
  /// An entry that was the next collision with a partner which has another flight now: its time stays as a
  /// bound.
  void doubt(std::int32_t id) { entry(id).is_doubtful = true; }
};

}  // namespace dch::kinetic
