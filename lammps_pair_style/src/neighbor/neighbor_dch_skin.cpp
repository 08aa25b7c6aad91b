// SPDX-License-Identifier: GPL-2.0-or-later
// `dch skin auto`.
#include <algorithm>
#include <atom.h>
#include <cmath>
#include <comm.h>
#include <update.h>

#include "neighbor_dch.h"

namespace LAMMPS_NS {

// A smaller skin is as safe as a larger one only if every step asks whether atoms have moved by half of it.
// Native lists with cutoffs by radius know the script's skin only.
void NeighborDCH::prepare_skin() {
  const bool any_by_radius =
      std::any_of(served_.begin(), served_.end(), [](const ServedList& served) { return served.by_radius; });
  skin_obstacle_.clear();
  if (!tunes_skin_) {
    tuner_.reset();
    return;
  }
  std::string& obstacle = skin_obstacle_;
  if (!dist_check) obstacle = "lists are rebuilt without a check (neigh_modify check no)";
  if (build_once) obstacle = "lists are built once (neigh_modify once yes)";
  if (any_by_radius) obstacle = "a granular list is in use";
  if (!native_plist_.empty()) obstacle = "a native list is in use";
  if (!(skin > 0)) obstacle = "it is 0";
  if (!obstacle.empty()) {
    if (comm->me == 0) utils::logmesg(lmp, "DCH: the skin stays as it is: " + obstacle + "\n");
    tuner_.reset();
    return;
  }
  every = 1;
  delay = 0;
  if (!tuner_ || tuner_->largest() != skin) tuner_.emplace(skin);
  const auto n = static_cast<std::size_t>(atom->ntypes) + 1;
  script_cutoffs_.assign(n * n, 0);
  for (std::size_t a = 1; a < n; ++a)
    for (std::size_t b = 1; b < n; ++b) script_cutoffs_[a * n + b] = std::sqrt(cutneighsq[a][b]);
  last_build_time_ = 0;
  apply_skin();
}

/// Tells the tuner what the last list has cost, by the slowest process, and takes its next proposal.
void NeighborDCH::choose_skin() {
  const double now = MPI_Wtime();
  if (!tuner_->settled() && last_build_time_ > 0) {
    double seconds = now - last_build_time_;
    MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_MAX, world);
    tuner_->observe(seconds, update->ntimestep - last_build_step_);
    apply_skin();
  }
  last_build_time_ = now;
  last_build_step_ = update->ntimestep;
}

/// The largest cutoff, by which ghosts are made, stays that of the script's skin.
void NeighborDCH::apply_skin() {
  const double less = skin - tuner_->skin();
  triggersq = 0.25 * tuner_->skin() * tuner_->skin();
  const auto n = static_cast<std::size_t>(atom->ntypes) + 1;
  for (std::size_t a = 1; a < n; ++a) {
    for (std::size_t b = 1; b < n; ++b) {
      const double cutoff = script_cutoffs_[a * n + b];
      if (cutoff > 0) cutneighsq[a][b] = (cutoff - less) * (cutoff - less);
    }
  }
}

}  // namespace LAMMPS_NS
