// SPDX-License-Identifier: GPL-2.0-or-later
// `dch expiry`.
#include <algorithm>
#include <atom.h>
#include <comm.h>
#include <cstring>
#include <domain.h>
#include <exception>
#include <fix.h>
#include <force.h>
#include <modify.h>
#include <neigh_list.h>
#include <pair.h>
#include <update.h>
#include <utility>

#include "known_fixes.h"
#include "lammps_versions.h"
#include "neighbor_dch.h"

namespace LAMMPS_NS {
namespace {

constexpr double kRounding = 1e-12;  ///< of distances, relative to the largest cutoff
constexpr const char* kCrossing = "necklace/crossing";

/// Whether a fix takes part in builds of lists.
bool is_called_at_builds(int mask) {
  using namespace FixConst;
  return (mask & (PRE_EXCHANGE | PRE_NEIGHBOR | POST_NEIGHBOR | MIN_PRE_EXCHANGE | MIN_PRE_NEIGHBOR |
                  MIN_POST_NEIGHBOR)) != 0;
}

/// Atoms that have left through a fixed boundary are lost at builds, and others take their places in memory.
bool can_lose_atoms(const Domain& domain) {
  constexpr int kFixed = 1;
  for (const auto& sides : domain.boundary)
    if (sides[0] == kFixed || sides[1] == kFixed) return true;
  return false;
}

}  // namespace

/// Whether a list holds no other pairs than lists of ours with the same cutoffs.
bool NeighborDCH::is_as_complete(const NeighList& list) const {
  if (list.ghost) return false;
  const bool is_ours = std::any_of(served_.begin(), served_.end(),
                                   [&](const ServedList& served) { return served.index == list.index; });
  if (is_ours) return true;
  const bool of_pair = list.requestor_type == NeighList::PAIR;
  const bool of_other = list.requestor_type == NeighList::FIX || list.requestor_type == NeighList::COMPUTE;
  // From the versions on that cut lists of others by distance, derived ones may have a cutoff of their own.
  if (of_other && dch::lammps::kHasTrim<Pair>) return false;
  if (of_pair && dch::lammps::wants_own_cutoff(*static_cast<const Pair*>(list.requestor))) return false;
  const NeighList* const parent = list.listcopy   ? list.listcopy
                                  : list.listskip ? list.listskip
                                                  : list.listfull;
  return parent != nullptr && is_as_complete(*parent);
}

std::string NeighborDCH::uncertain_list() const {
  for (int m = 0; m < nlist; ++m) {
    const NeighList& list = *lists[m];
    if (list.pair_method == 0 || !is_needed(m) || is_as_complete(list)) continue;
    return list_name(list) + (list.ghost ? ": rows of ghosts reach farther than pairs"
                                         : ": not ours, and may reach farther than pairs");
  }
  return {};
}

/// Whether atoms keep the order in which LAMMPS would have them, though builds are fewer.
bool NeighborDCH::keeps_order() const {
  return comm->nprocs == 1 && !can_lose_atoms(*domain) &&
         (atom->sortfreq <= 0 || delay <= 1 || order_.obstacle().empty());
}

std::string NeighborDCH::fix_against_expiry() const {
  for (int k = 0; k < modify->nfix; ++k) {
    const char* const name = modify->fix[k]->style;
    if (std::strcmp(name, kCrossing) == 0 && comm->nprocs > 1)
      return std::string("fix ") + name + " counts on ghosts within half the skin";
    if (expiry_rule_ == dch::lammps::ExpiryRule::exact || draws_no_random_numbers(name)) continue;
    if (keeps_order() && !is_called_at_builds(modify->fmask[k])) continue;
    return std::string("fix ") + name + " may draw random numbers in the order of atoms ('dch expiry exact')";
  }
  return {};
}

std::string NeighborDCH::settings_against_expiry() const {
  if (expiry_rule_ == dch::lammps::ExpiryRule::half) return "'dch expiry half' was given";
  if (!dist_check) return "lists are rebuilt without a check (neigh_modify check no)";
  if (build_once) return "lists are built once (neigh_modify once yes)";
  if (every != 1) return "not every step is looked at (neigh_modify every " + std::to_string(every) + ")";
  if (!(skin > 0)) return "the skin is 0";
  if (domain->box_change) return "the box changes";
  if (update->whichflag == 1 && std::strcmp(update->integrate_style, "verlet") != 0)
    return std::string("run_style ") + update->integrate_style + " does not look at lists at each step";
  return {};
}

void NeighborDCH::prepare_expiry() {
  expiry_obstacle_ = settings_against_expiry();
  if (expiry_obstacle_.empty()) expiry_obstacle_ = uncertain_list();
  if (expiry_obstacle_.empty()) expiry_obstacle_ = fix_against_expiry();
  half_life_ = 0;
  // Atoms migrate to the next process, which a thin part of the box may not be.
  stays_near_ = force->kspace != nullptr || comm->nprocs > 1;
  for (int k = 0; k < modify->nfix; ++k)
    if (!draws_no_random_numbers(modify->fix[k]->style)) stays_near_ = true;
  // Atoms in an order of ours are put back, in the end, in that of LAMMPS's last sort.
  const bool sorts = comm->nprocs == 1 && atom->sortfreq > 0 &&
                     (!order_.obstacle().empty() ||
                      update->laststep >= (update->ntimestep / atom->sortfreq + 1) * atom->sortfreq);
  stock_builds_.begin_run(expiry_obstacle_.empty() && sorts && delay <= 1);
}

/// What LAMMPS's rule says of our last build. The base class takes what the box has changed by from `skin`.
bool NeighborDCH::moved_half_skin() {
  const double of_script = std::exchange(skin, present_skin());
  const bool moved = Neighbor::check_distance() != 0;
  skin = of_script;
  return moved;
}

int NeighborDCH::check_distance() {
  const bool moved_far = moved_half_skin();
  if (!expiry_obstacle_.empty() || every != 1) return moved_far ? 1 : 0;
  const bool would_build = stock_builds_.is_due(moved_far, triggersq);
  const bool builds = (would_build && stock_builds_.would_sort()) || (moved_far && !lists_hold_all());
  if (builds && !would_build) stock_builds_.defer_sort();
  if (!builds && would_build) stock_builds_.note_missed();
  return builds ? 1 : 0;
}

ListExpiry::Verdict NeighborDCH::own_verdict() {
  if (!points_.in_box()) comm->forward_comm();
  if (expiry_.any_outside()) return ListExpiry::Verdict::cannot_tell;
  try {
    return expiry_.judge(points_, *search_, xhold, wanted_pairs());
  } catch (const std::exception&) {  // other processes wait; the build that follows says what is wrong
    return ListExpiry::Verdict::cannot_tell;
  }
}

/// Whether lists that half the skin would end hold every pair within its cutoff; all processes agree. Not
/// asked where steps have passed without a look: LAMMPS counts such builds as dangerous.
bool NeighborDCH::lists_hold_all() {
  if (ago == std::max(every, delay)) return false;
  if (half_life_ == 0) half_life_ = ago;
  const double begin = MPI_Wtime();
  int verdict = static_cast<int>(own_verdict());
  MPI_Allreduce(MPI_IN_PLACE, &verdict, 1, MPI_INT, MPI_MAX, world);
  ++run_.verdicts[static_cast<std::size_t>(verdict)];
  run_.expiry_seconds += MPI_Wtime() - begin;
  return verdict == static_cast<int>(ListExpiry::Verdict::kept);
}

ListExpiry::Wanted NeighborDCH::wanted_pairs() const {
  const auto by_radius = [](const ServedList& served) { return served.by_radius; };
  ListExpiry::Wanted wanted{};
  wanted.skin = present_skin();
  wanted.by_radii = std::any_of(served_.begin(), served_.end(), by_radius);
  wanted.by_types = !clusters_.empty() || !std::all_of(served_.begin(), served_.end(), by_radius);
  wanted.stays_near = stays_near_;
  wanted.rounding = kRounding * cutneighmax + 2 * images_.error_within(cutneighmax);
  return wanted;
}

/// A build begins: what the last lists' lives were.
void NeighborDCH::note_expiry() {
  stock_builds_.note_build();
  run_.builds_saved = builds_saved();
  half_life_ = 0;
}

/// Builds that half the skin would have asked for beside those that there were: lists have lived so many
/// times as long as until they were first asked.
double NeighborDCH::builds_saved() const {
  return run_.builds_saved + (half_life_ > 0 ? static_cast<double>(ago) / half_life_ - 1 : 0);
}

}  // namespace LAMMPS_NS
