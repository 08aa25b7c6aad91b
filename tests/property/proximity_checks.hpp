// SPDX-License-Identifier: MIT
#pragma once

#include <dch/proximity/kept_closest_pair.hpp>

#include "proximity_scene.hpp"

namespace dch {

/// Each asks one query of a scene as it is, with parameters drawn at random, and compares the answer with all
/// pairs. They stand beside the tests of their queries.
void check_nearest(ProximityScene& scene);
void check_neighbors_within(ProximityScene& scene);
void check_spanning_tree(ProximityScene& scene);
void check_well_separated_pairs(ProximityScene& scene);
void check_spanner(ProximityScene& scene);
/// Of up to 12 points with the best of all sets of centers, too.
void check_centers(ProximityScene& scene);
void check_closest_pair(ProximityScene& scene);
/// @param kept asked at other times before, or not
void check_kept_closest_pair(ProximityScene& scene, KeptClosestPair& kept);
void check_far_sums(ProximityScene& scene);

}  // namespace dch
