// SPDX-License-Identifier: MIT
#pragma once

#include <dch/proximity/kept_closest_pair.hpp>
#include <dch/proximity/point_tree.hpp>

#include "proximity_scene.hpp"

namespace dch {

/// Each asks one query of a scene as it is, with parameters drawn at random, and compares the answer with all
/// pairs. They stand beside the tests of their queries.
void check_nearest(ProximityScene& scene);
void check_neighbors_within(ProximityScene& scene);
void check_spanning_tree(ProximityScene& scene);
void check_well_separated_pairs(ProximityScene& scene);
/// Here and below: of a tree that was kept up.
void check_well_separated_pairs(ProximityScene& scene, const PointTree& kept);
void check_spanner(ProximityScene& scene);
void check_spanner(ProximityScene& scene, const PointTree& kept);
/// Of up to 12 points with the best of all sets of centers, too.
void check_centers(ProximityScene& scene);
void check_centers(ProximityScene& scene, const PointTree& kept);
void check_closest_pair(ProximityScene& scene);
void check_closest_pair(ProximityScene& scene, const PointTree& kept);
/// Brings a tree up to date, and compares it with all points.
void check_kept_point_tree(ProximityScene& scene, PointTree& kept);
/// @param kept asked at other times before, or not
void check_kept_closest_pair(ProximityScene& scene, KeptClosestPair& kept);
void check_far_sums(ProximityScene& scene);

}  // namespace dch
