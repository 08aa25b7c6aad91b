// SPDX-License-Identifier: MIT
#pragma once

#include <dch/hierarchy/hierarchy_params.hpp>

namespace dch::detail {

/// How the edge thresholds rho_i of the conflict graph grow with the level.
enum class EdgeRule {
  /// rho_{i+1} = rho_i + 2 R_i, the smallest thresholds for which Lemma 5.3.1(5) holds: far fewer edges.
  additive,
  /// rho_i = 2 c R_i, as the thesis defines G_c.
  thesis
};

/// What a structure is made by: what callers choose, and what the library chooses for them. Others than these
/// defaults give the hierarchy as the thesis defines it, and small structures with many levels, which tests
/// compare with.
struct StructureParams : HierarchyParams {
  StructureParams() = default;
  StructureParams(const HierarchyParams& chosen)
      : HierarchyParams(chosen) {}  // NOLINT(google-explicit-constructor)

  /// R_0, the radius within which level 1 covers the points [length]. 0: with EdgeRule::additive 2^k r0 for
  /// the k that gives a node of level 1 about 150 children, which suits lists (measured at each build); with
  /// EdgeRule::thesis r0. At most 16 times the smallest height of a periodic box, if that is wider anywhere.
  double base_radius = 0;
  /// c >= 1.05, ties the scale of the levels to the list: 2 c r0 = radius. EdgeRule::thesis: larger c means
  /// smaller balls, more levels and edges, more slack.
  double c = 1.05;
  EdgeRule edge_rule = EdgeRule::additive;
  /// Levels are added until this many nodes or fewer are left at the top; those are the roots of a forest and
  /// all pairs of them are looked at. 1 gives the hierarchy of the thesis, with a single root.
  int max_roots = 16;
  /// Path compression: points that have no neighbor in level i >= 2 nor a point below them are in memory in
  /// levels i and above only, and in no leaf; so that gas in a huge box costs as much as in a small one.
  bool collapse_singletons = true;
  /// Whether positions stand in the blocks of the points too, wrapped, and relative to the center of their
  /// leaf: queries of single points are fast with these. Lists take them from the positions by id, at no more
  /// time.
  bool keeps_block_positions = true;
};

}  // namespace dch::detail
