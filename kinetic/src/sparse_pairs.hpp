// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/kinetic/flight_plan.hpp>

#include "images.hpp"
#include "pair_tournament.hpp"

namespace dch::kinetic {

/// All pairs that may be the closest one for a while, where points are so few that no two are within the
/// largest distance of an edge in a periodic box: then several images of a pair count.
struct SparsePairs {
  std::vector<PairTournament::Contender> contenders;
  double horizon = kNever;  ///< nothing is known beyond
};

/// O(n^2).
/// @param plans begun at `now` or before
SparsePairs find_sparse_pairs(const Images& images, Span<const FlightPlan> plans, double now);

/// Calls f for each lattice vector that makes an image of a displacement which may be the nearest one when
/// the displacement has changed by a way; the one that is nearest now among them.
void for_each_image_near(const Box& box, Vec3 displacement, double way, const std::function<void(Vec3)>& f);

}  // namespace dch::kinetic
