// SPDX-License-Identifier: GPL-2.0-or-later
// What `dch stats` prints, summed over the processes.
#include <array>
#include <atom.h>
#include <comm.h>

#include <dch/base/instruction_set.hpp>

#include "neighbor_dch.h"

namespace LAMMPS_NS {
namespace {

/// Each time becomes that of the process that took longest.
void take_longest_times(dch::lammps::RunCounters& counters, MPI_Comm world) {
  using Counters = dch::lammps::RunCounters;
  constexpr std::array members{
      &Counters::points_seconds,   &Counters::structure_seconds,       &Counters::rows_seconds,
      &Counters::fill_seconds,     &Counters::verified_native_seconds, &Counters::verified_dch_seconds,
      &Counters::clusters_seconds, &Counters::expiry_seconds};
  std::array<double, members.size()> times{};
  for (std::size_t k = 0; k < members.size(); ++k) times[k] = counters.*members[k];
  MPI_Allreduce(MPI_IN_PLACE, times.data(), static_cast<int>(times.size()), MPI_DOUBLE, MPI_MAX, world);
  for (std::size_t k = 0; k < members.size(); ++k) counters.*members[k] = times[k];
}

}  // namespace

/// What the run went by.
dch::lammps::RunReport NeighborDCH::settings_of_run() const {
  dch::lammps::RunReport report;
  report.enabled = enabled_;
  if (tuner_) report.skin = tuner_->skin();
  report.skin_settled = tuner_ && tuner_->settled();
  report.verify_every = verify_every_;
  report.processes = comm->nprocs;
  report.radius = params_.radius;
  report.engine = engine_in_use_;
  report.engine_reason = engine_reason_;
  report.by_size = params_.size_classes;
  report.size_reason = size_reason_;
  report.threads = threads_;
  report.script_skin = skin;
  report.skin_obstacle = skin_obstacle_;
  report.in_box = points_.in_box();
  report.leaves_ghosts_to_others = !points_.in_box() && !points_.has_ghosts_of_others();
  report.leaves_far_ghosts = !points_.in_box() && !points_.has_far_ghosts();
  report.order_obstacle = order_.obstacle();
  report.ghosts_for = ghosts_for_;
  report.expiry_obstacle = expiry_obstacle_;
  report.instructions = dch::name(dch::instruction_set());
  return report;
}

dch::lammps::RunReport NeighborDCH::report() const {
  const dch::SearchStats now = search_stats();
  std::size_t bytes = now.memory_bytes;
  std::int64_t entries = run_.entries;
  for (const ServedList& served : served_) bytes += served.memory_bytes();
  for (const ServedClusters& clusters : clusters_) bytes += clusters.list->memory_bytes();
  if (run_.builds > 0)  // not at each build, as it takes a twentieth of one
    for (const ServedClusters& clusters : clusters_) entries += clusters.list->count();

  const std::string choice = search_ ? search_->choice() : std::string();

  std::array<std::int64_t, 9> sums{entries,
                                   run_.verified_entries,
                                   now.promotions - before_run_.promotions,
                                   now.demotions - before_run_.demotions,
                                   now.inserted - before_run_.inserted,
                                   now.removed - before_run_.removed,
                                   static_cast<std::int64_t>(bytes),
                                   atom->nlocal,
                                   choice.rfind("grid", 0) == 0 ? 1 : 0};
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_LMP_BIGINT, MPI_SUM, world);
  std::array<std::int64_t, 4> largest{now.builds - before_run_.builds, now.repairs - before_run_.repairs,
                                      now.levels, now.refreshes - before_run_.refreshes};
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(largest.size()), MPI_LMP_BIGINT, MPI_MAX,
                world);

  dch::lammps::RunReport report = settings_of_run();
  report.choice = choice;
  report.processes_on_grid = static_cast<int>(sums[8]);
  report.counters = run_;
  report.counters.builds_saved = builds_saved();
  report.counters.entries = sums[0];
  report.counters.verified_entries = sums[1];
  take_longest_times(report.counters, world);
  report.promotions = sums[2];
  report.demotions = sums[3];
  report.inserted = sums[4];
  report.removed = sums[5];
  report.memory_bytes = sums[6];
  report.atoms = sums[7];
  report.structures_built = largest[0];
  report.repairs = largest[1];
  report.levels = static_cast<int>(largest[2]);
  report.refreshes = largest[3];
  report.lists = notes_;
  return report;
}

}  // namespace LAMMPS_NS
