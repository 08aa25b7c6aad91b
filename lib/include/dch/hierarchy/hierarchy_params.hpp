// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/executor.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// When update() repairs and when it builds anew.
enum class MaintenancePolicy {
  automatic,      ///< nothing as long as lists are certified to be complete without, then whichever is less
                  ///< work, as counted before: the same on any machine, however busy
  always_repair,  ///< build once, then repair
  always_rebuild  ///< build at every update
};

/// List radii that a hierarchy can have [length]: coordinates relative to leaves, and their inverse units,
/// stay within single precision.
inline constexpr double kMinListRadius = 1e-30, kMaxListRadius = 1e30;

struct HierarchyParams {
  /// rho_0, the edge threshold of level 0, kMinListRadius..kMaxListRadius [length]: cutoff + skin of the list
  /// that the level-0 edges are.
  double radius = 0;
  MaintenancePolicy policy = MaintenancePolicy::automatic;
  /// Threads to make lists with; null for that of the caller alone. Not owned; results do not depend on it.
  Executor* executor = nullptr;
  /// For make_dch_search: whether the cutoffs of particles may differ much, by radii or types. Then there is
  /// a hierarchy for each class of sizes, made when a list is asked for; `radius` is the largest list radius.
  bool size_classes = false;
};

}  // namespace dch
#pragma GCC visibility pop
