// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/executor.hpp>

namespace dch {

/// How the edge thresholds rho_i of the conflict graph grow with the level.
enum class EdgeRule {
  /// rho_{i+1} = rho_i + 2 R_i, the smallest thresholds for which Lemma 5.3.1(5) holds: far fewer edges.
  additive,
  /// rho_i = 2 c R_i, as the thesis defines G_c.
  thesis
};

/// When update() repairs and when it builds anew.
enum class MaintenancePolicy {
  automatic,      ///< nothing as long as lists are certified to be complete without, then whichever is less
                  ///< work, as counted before: the same on any machine, however busy
  always_repair,  ///< build once, then repair
  always_rebuild  ///< build at every update
};

/// List radii that a hierarchy can have [length]: coordinates relative to clusters, and their inverse units,
/// stay within single precision.
inline constexpr double kMinListRadius = 1e-30, kMaxListRadius = 1e30;

struct HierarchyParams {
  /// rho_0, the edge threshold of level 0, kMinListRadius..kMaxListRadius [length]: cutoff + skin of the list
  /// that the level-0 edges are.
  double radius = 0;
  /// R_0, the radius within which level 1 covers the points [length]. 0: with EdgeRule::additive 2^k r0 for
  /// the k that gives a node of level 1 about 150 children, which suits lists (measured at each build); with
  /// EdgeRule::thesis r0. At most 16 times the smallest height of a periodic box, if that is wider anywhere.
  double base_radius = 0;
  /// c >= 1.05, ties the scale of the levels to the list: 2 c r0 = radius. EdgeRule::thesis: larger c means
  /// smaller balls, more levels and edges, more slack.
  double c = 1.05;
  EdgeRule edge_rule = EdgeRule::additive;
  MaintenancePolicy policy = MaintenancePolicy::automatic;
  /// Levels are added until this many nodes or fewer are left at the top; those are the roots of a forest and
  /// all pairs of them are looked at. 1 gives the hierarchy of the thesis, with a single root.
  int max_roots = 16;
  /// Path compression: points that have no neighbor in level i >= 2 nor a point below them are in memory in
  /// levels i and above only, and in no cluster of level 1; so that gas in a huge box costs as much as in a
  /// small one.
  bool fold_lone_points = true;
  /// Threads to make lists with; null for that of the caller alone. Not owned; results do not depend on it.
  Executor* executor = nullptr;
  /// For make_dch_search: whether the cutoffs of particles may differ much, by radii or types. Then there is
  /// a hierarchy for each class of sizes, made when a list is asked for; `radius` is the largest list radius.
  bool size_classes = false;
};

}  // namespace dch
