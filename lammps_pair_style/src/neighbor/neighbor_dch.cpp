// SPDX-License-Identifier: GPL-2.0-or-later
#include "neighbor_dch.h"

#include <algorithm>
#include <atom.h>
#include <cmath>
#include <comm.h>
#include <cstdio>
#include <error.h>
#include <neigh_list.h>
#include <new>
#include <typeinfo>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>

#include "fix_dch_order.h"
#include "fix_dch_work.h"
#include "neighbor_dch_only.h"
#include "ordered_commands.h"

namespace LAMMPS_NS {

using namespace NeighConst;

namespace {

// The search reaches farther than the cutoff, by more than rounding can move an atom.
constexpr double kRadiusMargin = 1.0 + 1e-6;

// A pair of clusters' pairs takes less time than one by one, by these factors: see docs/lammps/measured.md.
constexpr double kMostPairsDouble = 2.7, kMostPairsMixed = 4.2;

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

std::unique_ptr<ClusterListFiller> make_cluster_filler(LAMMPS* lammps, SpecialPairs& special,
                                                       const PairRules& rules) {
  return std::make_unique<ClusterListFiller>(lammps, special, rules);
}

NeighborDCH::NeighborDCH(Neighbor* retired, const NeighborParts& parts)
    : Neighbor(*retired),
      retired_(retired),
      points_(lmp),
      order_(lmp),
      images_(lmp),
      parts_(parts),
      expiry_(lmp),
      stock_builds_(lmp),
      special_(lmp),
      sides_(lmp),
      reach_(lmp),
      rules_(lmp, sides_),
      filler_(lmp, special_, rules_),
      cluster_filler_(parts.cluster_filler(lmp, special_, rules_)),
      verifier_(lmp),
      cluster_verifier_(lmp, verifier_, rules_) {
  // Both objects hold the same arrays now; with this flag of the base class the old one's destructor frees
  // nothing.
  retired->*(&NeighborDCH::copymode) = 1;
}

NeighborDCH::~NeighborDCH() { show_bins(); }

NeighborDCH* NeighborDCH::install(LAMMPS* lammps, const NeighborParts& parts) {
  const Neighbor& present = *lammps->neighbor;
  if (typeid(present) == typeid(NeighborDCH)) return static_cast<NeighborDCH*>(lammps->neighbor);
  if (lammps->kokkos) {
    lammps->error->all(
        FLERR,
        std::string("The dch command cannot replace the neighbor lists of KOKKOS; start LAMMPS without "
                    "'-k on'"));
  }
  if (typeid(present) != typeid(Neighbor)) {
    lammps->error->all(
        FLERR,
        std::string("The dch command replaces LAMMPS's own neighbor class, but this LAMMPS runs another "
                    "one; use either, not both"));
  }
  auto* ours = new NeighborDCH(lammps->neighbor, parts);
  lammps->neighbor = ours;
  restore_order_before_commands(*lammps);
  return ours;
}

void NeighborDCH::restore_order_between_runs() {
  if (!order_.restore()) return;
  // The place of the first ghost was needed, and IDs are in other places.
  atom->nghost = 0;
  if (atom->map_style == Atom::MAP_NONE) return;
  atom->map_init();
  atom->map_set();
}

void NeighborDCH::enable(const std::string& engine) {
  enabled_ = true;
  engine_ = engine;
}

void NeighborDCH::disable() {
  enabled_ = false;
  expiry_obstacle_ = "'dch off' was given";
  show_bins();
}

// --------------------------------------------------------------------------------------------------------------------
// Which lists are ours

void NeighborDCH::init() {
  if (enabled_ && atom->molecular == Atom::TEMPLATE) {
    error->all(FLERR, std::string(
                          "DCH neighbor lists do not know the bonds of atom_style template; use another atom "
                          "style or give 'dch off' before the run"));
  }
  show_bins();
  show_cutoffs();
  ghosts_for_ = "no DCH list is in use";
  Neighbor::init();
  FixDCHWork::note_current(lmp);
  const std::vector<dch::lammps::ListNote> before = std::exchange(notes_, {});
  run_ = {};
  before_run_ = {};
  half_life_ = 0;
  expiry_obstacle_ = "no DCH list is in use";
  stock_builds_.begin_run(false);
  clusters_ = std::exchange(requested_clusters_, {});
  notes_ = std::exchange(requested_notes_, {});
  if (!enabled_ && clusters_.empty()) {
    served_.clear();
    tuner_.reset();
    return;
  }
  rules_.copy_settings();
  classify_references();
  give_up_clusters_by_levels();
  classify_lists();
  announce(before);
  if (served_.empty() && clusters_.empty()) {
    tuner_.reset();
    return;
  }
  prepare_search();
  check_engine_makes_clusters();
  prepare_skin();
  before_run_ = search_stats();
  order_.begin_run();
  if (any_by_radius()) order_.note_grains();
  prepare_expiry();
  ghosts_for_ = need_of_ghosts();
  if (order_.obstacle().empty() || ghosts_for_.empty()) FixDCHOrder::install(lmp);
  hide_bins();
}

bool NeighborDCH::any_by_radius() const {
  return std::any_of(served_.begin(), served_.end(),
                     [](const ServedList& served) { return served.by_radius; });
}

/// Whether sizes differ so much that a hierarchy for each class of sizes is faster than one for all.
bool NeighborDCH::sizes_differ_much() {
  constexpr double kRatio = 2;
  const bool of_grains = any_by_radius();
  double ratio = 1;
  if (of_grains) {
    const auto [min, max] = std::minmax_element(atom->radius, atom->radius + atom->nlocal);
    if (atom->nlocal > 0) ratio = *max / *min;
  } else {
    for (int a = 1; a <= atom->ntypes; ++a) {
      const double own = std::sqrt(cutneighsq[a][a]);
      if (own > skin) ratio = std::max(ratio, cutneighmax / own);
    }
  }
  size_reason_ = (of_grains ? "the largest grain is " : "the largest cutoff with the skin is ") +
                 short_number(ratio) +
                 (of_grains ? " times the smallest" : " times the least of a type with itself");
  return ratio > kRatio;
}

/// How many pairs cluster pairs hold for each pair of a list: they go as far for all types. By the number of
/// atoms of each type, on all processes, as if types were mixed evenly.
double NeighborDCH::pairs_of_clusters() const {
  const auto types = static_cast<std::size_t>(atom->ntypes) + 1;
  std::vector<bigint> atoms(types, 0);
  for (int i = 0; i < atom->nlocal; ++i) ++atoms[static_cast<std::size_t>(atom->type[i])];
  MPI_Allreduce(MPI_IN_PLACE, atoms.data(), static_cast<int>(types), MPI_LMP_BIGINT, MPI_SUM, world);
  double of_clusters = 0, of_lists = 0;
  for (std::size_t a = 1; a < types; ++a) {
    for (std::size_t b = 1; b < types; ++b) {
      const double partners = static_cast<double>(atoms[a]) * static_cast<double>(atoms[b]);
      of_clusters += partners * std::pow(cutneighmax, 3);
      of_lists += partners * std::pow(cutneighsq[a][b], 1.5);
    }
  }
  return of_lists > 0 ? of_clusters / of_lists : 1;
}

/// There are no cluster pairs of size classes, but pairs one by one.
bool NeighborDCH::choose_size_classes() {
  if (!sizes_differ_much()) return false;
  if (clusters_.empty()) return true;
  const double most = precision_ == dch::ForcePrecision::mixed ? kMostPairsMixed : kMostPairsDouble;
  const double pairs = pairs_of_clusters();
  size_reason_ += ", and cluster pairs without them hold " + short_number(pairs) +
                  " times the pairs of lists" + (pairs > most ? ", more than " : ", at most ") +
                  short_number(most);
  return pairs > most;
}

/// A process that is alone keeps the hierarchy of the atoms in its box with little work, and their order in
/// memory suits pair styles. Of several, each would have to take atoms and ghosts in and out of it at every
/// build, where a grid is made anew.
std::string NeighborDCH::wanted_engine() const {
  if (enabled_ && !engine_.empty()) return engine_;
  return comm->nprocs == 1 ? "dch" : "auto";
}

void NeighborDCH::prepare_search() {
  const double radius = reach() * kRadiusMargin;
  const bool by_size = choose_size_classes();
  const int threads = pool_ ? pool_->threads() : 1;
  const std::string engine = wanted_engine();
  engine_reason_ = enabled_ ? "'dch on' takes it for lists" : "cluster pairs are asked for without 'dch on'";
  if (enabled_ && !clusters_.empty()) engine_reason_ += " and cluster pairs";
  if (!enabled_ || engine_.empty())
    engine_reason_ += comm->nprocs == 1 ? " on one process" : " on several processes";
  const bool is_ready = search_ && radius == params_.radius && by_size == params_.size_classes &&
                        threads == threads_ && engine == engine_in_use_;
  if (is_ready) return;
  engine_in_use_ = engine;
  params_ = {};
  params_.radius = radius;
  params_.size_classes = by_size;
  search_.reset();
  try {
    if (threads != threads_) pool_ = threads_ > 1 ? dch::make_thread_pool(threads_) : nullptr;
    params_.executor = pool_.get();
    search_ = parts_.search(engine, params_);
  } catch (const dch::Error& e) {
    error->all(FLERR, std::string("DCH neighbor lists: ") + e.what());
  }
}

/// A style that asks for cluster pairs has no list to fall back on by then.
void NeighborDCH::check_engine_makes_clusters() {
  if (clusters_.empty() || search_->has_cluster_pairs() || params_.size_classes) return;
  error->all(FLERR,
             "DCH neighbor lists: the engine '" + engine_in_use_ +
                 "' makes no cluster pairs, which pair styles with the suffix dch compute forces with; give "
                 "'dch on engine auto' or 'dch on engine dch', or 'suffix off' before the pair_style");
}

// setup_bins() is not virtual and runs outside build(): where bins are in sight stock code sizes them, and
// stops at large or sparse systems with "Too many neighbor bins", although nobody reads them.
void NeighborDCH::hide_bins() {
  for (int m = 0; m < nlist; ++m) {
    const bool ours = std::find(served_plist_.begin(), served_plist_.end(), m) != served_plist_.end();
    if (!ours && is_needed(m) && lists[m]->bin_method > 0) return;
  }
  bins_hidden_ = true;
  all_bins_ = std::exchange(nbin, 0);
  stencils_in_use_ = std::exchange(nstencil_perpetual, 0);
  all_stencils_ = std::exchange(nstencil, 0);  // whose memory LAMMPS counts, though they are not set up
}

void NeighborDCH::show_bins() {
  if (!bins_hidden_) return;
  bins_hidden_ = false;
  nbin = all_bins_;
  nstencil = all_stencils_;
  nstencil_perpetual = stencils_in_use_;
  last_setup_bins = -1;  // makes the next native build size them first
}

}  // namespace LAMMPS_NS
