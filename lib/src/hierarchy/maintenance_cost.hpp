// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include <dch/geometry/box.hpp>

namespace dch::detail {

/// What decides how long it takes to bring a structure up to date. Counted, never timed, so that a program
/// does the same whenever and wherever it runs (docs/decisions/0012-repair-or-rebuild-by-counted-work.md).
struct MaintenanceWork {
  double points = 0;
  double samples = 0;     ///< distances that the search for R_0 computes
  double edges = 0;       ///< of levels 1 and above, in both directions
  double orphans = 0;     ///< nodes and points that will need another parent
  double candidates = 0;  ///< their parents of now and the neighbors of these, orphan by orphan
};

/// Share of the children of a demoted node that the node they are handed to does not cover: 0.41 over all
/// scenes.
inline constexpr double kOrphansOfDemoted = 0.4;

/// Share of the nodes that may lie away from their siblings before all are put in order again. Not critical:
/// without any reordering, repair and list of a melt of 32,000 atoms took 3 % longer after 120 rebuilds.
inline constexpr double kMaxMisplaced = 0.1;

/// Times of parts of the work [ns]: least squares over the scenes and steps of `dch_bench_maintenance`, with
/// AVX-512 on one processor of an Intel Xeon with AMX. Only their ratios matter, and these not much.
struct MaintenanceWeights {
  struct {
    double point, edge, orphan, candidate, reordered_point;
  } repair;
  struct {
    double point, sample, edge, orphan;
  } build;
  struct {
    double particle, candidate;
  } exchange;  ///< to insert or remove one, among so many leaves
};
inline constexpr MaintenanceWeights kWeightsInBricks{
    {12.5, 15, 38, 5.3, 103}, {130, 10, 46, 103}, {100, 7.5}};
/// The nearest image in a skewed box takes longer.
inline constexpr MaintenanceWeights kWeightsInLattices{{97, 15, 38, 25, 103}, {295, 10, 46, 103}, {100, 27}};

inline const MaintenanceWeights& weights_in(const Box& box) {
  return box.any_periodic() && box.kind() == Box::Kind::triclinic ? kWeightsInLattices : kWeightsInBricks;
}

/// Time to repair, with its share of the next reordering [ns].
inline double repair_cost(const MaintenanceWork& work, const MaintenanceWeights& weights) {
  const auto& [point, edge, orphan, candidate, reordered_point] = weights.repair;
  return point * work.points + edge * work.edges + orphan * work.orphans + candidate * work.candidates +
         reordered_point * std::min(work.points, work.orphans / kMaxMisplaced);
}

/// Time to build anew, longer where points have left those that they lie beside in memory [ns].
inline double build_cost(const MaintenanceWork& work, const MaintenanceWeights& weights) {
  const auto& [point, sample, edge, orphan] = weights.build;
  return point * work.points + sample * work.samples + edge * work.edges + orphan * work.orphans;
}

}  // namespace dch::detail
