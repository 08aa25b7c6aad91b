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
  if (comm->cutghostuser > 0 || comm->cutusermulti || comm->cutusermultiold) return "comm_modify cutoff";
  if (domain->box_change) return "the box changes";  // Atom::sort() makes bins anew, by half of cutneighmax
  if (!may_use_box()) return "the box is not more than twice as wide as the cutoff";
  return reader_of_ghosts();
}

/// The cutoffs that LAMMPS takes the width of the region of ghosts from, as comm_modify says; of collections
/// squared.
dch::Span<double> NeighborDCH::cutoffs_of_ghosts() {
  const auto collections = static_cast<std::size_t>(ncollections);
  if (comm->mode == Comm::MULTI) return {cutcollectionsq[0], collections * collections};
  if (comm->mode == Comm::MULTIOLD) return {cuttype + 1, static_cast<std::size_t>(atom->ntypes)};
  return {&cutneighmax, 1};
}

/// From between the decision to build lists and the exchange of atoms. The build that follows has the cutoffs
/// back.
void NeighborDCH::leave_out_ghosts() {
  if (!ghosts_for_.empty() || !full_cutoffs_.empty()) return;
  const double hardly_any = comm->mode == Comm::MULTI ? kHardlyAny * kHardlyAny : kHardlyAny;
  for (double& cutoff : cutoffs_of_ghosts())
    full_cutoffs_.push_back(std::exchange(cutoff, hardly_any * cutoff));
}

void NeighborDCH::show_cutoffs() {
  // They are others where a command has changed the mode after an error; then LAMMPS has them anew.
  if (!full_cutoffs_.empty() && full_cutoffs_.size() == cutoffs_of_ghosts().size())
    std::copy(full_cutoffs_.begin(), full_cutoffs_.end(), cutoffs_of_ghosts().begin());
  full_cutoffs_.clear();
}

}  // namespace LAMMPS_NS
