// SPDX-License-Identifier: GPL-2.0-or-later
// Runs without ghosts. Where one process has the whole box, forces over cluster pairs take images by the box,
// so LAMMPS makes ghosts, sends their positions and takes back their forces at every step for nobody.
#include <algorithm>
#include <atom.h>
#include <comm.h>
#include <compute.h>
#include <cstring>
#include <domain.h>
#include <fix.h>
#include <force.h>
#include <modify.h>
#include <update.h>
#include <utility>

#include "known_fixes.h"
#include "neighbor_dch.h"

namespace LAMMPS_NS {
namespace {

// Of the largest cutoff. LAMMPS warns of a cutoff of ghosts that is 0.
constexpr double kHardlyAny = 1e-9;

}  // namespace

std::string NeighborDCH::reader_of_ghosts() const {
  for (int k = 0; k < modify->nfix; ++k)
    if (!is_fix_without_ghosts(modify->fix[k]->style)) return std::string("fix ") + modify->fix[k]->style;
  for (int k = 0; k < modify->ncompute; ++k)
    if (!is_compute_without_ghosts(modify->compute[k]->style))
      return std::string("compute ") + modify->compute[k]->style;
  return {};
}

/// Why ghosts are made in the run that begins; empty if they need not be.
std::string NeighborDCH::need_of_ghosts() const {
  if (comm->nprocs > 1) return "other processes have a part of the atoms";
  if (update->whichflag != 1 || std::strcmp(update->integrate_style, "verlet") != 0)
    return "not a run with run_style verlet";
  if (clusters_.size() != 1 || clusters_.front().asker != force->pair)
    return "pair forces do not come from cluster pairs alone";
  if (std::find(needed_.begin(), needed_.end(), 1) != needed_.end()) return "a neighbor list is in use";
  if (verifies()) return "'dch verify' was given";
  if (tuner_) return "'dch skin auto' was given";
  if (atom->molecular != Atom::ATOMIC) return "atoms may have bonds";
  if (force->kspace) return "kspace_style";
  if (domain->box_change) return "the box changes";  // Atom::sort() makes bins anew, by half of cutneighmax
  if (!may_use_box()) return "the box is not more than twice as wide as the cutoff";
  return reader_of_ghosts();
}

/// From between the decision to build lists and the exchange of atoms: LAMMPS takes the width of the region
/// of ghosts from the largest cutoff. The build that follows has it back.
void NeighborDCH::leave_out_ghosts() {
  if (ghosts_for_.empty() && full_cutoff_ == 0)
    full_cutoff_ = std::exchange(cutneighmax, kHardlyAny * cutneighmax);
}

void NeighborDCH::show_cutoff() {
  if (full_cutoff_ > 0) cutneighmax = std::exchange(full_cutoff_, 0.0);
}

}  // namespace LAMMPS_NS
