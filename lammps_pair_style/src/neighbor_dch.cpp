// SPDX-License-Identifier: GPL-2.0-or-later
#include "neighbor_dch.h"

#include <algorithm>
#include <array>
#include <atom.h>
#include <cmath>
#include <comm.h>
#include <compute.h>
#include <error.h>
#include <fix.h>
#include <force.h>
#include <neigh_list.h>
#include <new>
#include <pair.h>
#include <typeinfo>
#include <update.h>
#include <utility>

#include <dch/error.hpp>

namespace LAMMPS_NS {

using namespace NeighConst;

namespace {

// The search reaches farther than the cutoff, by more than rounding can move an atom.
constexpr double kRadiusMargin = 1.0 + 1e-6;

// A pair of types without interaction has cutoff 0 in LAMMPS, which still lists coincident atoms.
constexpr double kSmallestCutoff = 1e-100;

double seconds_since(double& start) {
  const double now = MPI_Wtime();
  return now - std::exchange(start, now);
}

// Which list LAMMPS makes this one from; empty if from none.
std::string derivation(const NeighList& list) {
  if (list.listcopy) return "a copy of list " + std::to_string(list.listcopy->index + 1);
  if (list.listfull) return "the half of list " + std::to_string(list.listfull->index + 1);
  if (list.listskip) return "a part of list " + std::to_string(list.listskip->index + 1);
  return {};
}

}  // namespace
}  // namespace LAMMPS_NS

std::unique_ptr<dch::PairSearch> dch::lammps::make_search(const HierarchyParams& params) {
  return make_dch_search(params);
}

namespace LAMMPS_NS {

/// Restricts what Neighbor::build() builds to some of the perpetual lists while it lives.
class NeighborDCH::OnlyTheseLists {
 public:
  OnlyTheseLists(NeighborDCH& neighbor, std::vector<int>& lists)
      : neighbor_(neighbor),
        plist_(std::exchange(neighbor.plist, lists.data())),
        npair_(std::exchange(neighbor.npair_perpetual, static_cast<int>(lists.size()))) {}
  ~OnlyTheseLists() {
    neighbor_.plist = plist_;
    neighbor_.npair_perpetual = npair_;
  }
  OnlyTheseLists(const OnlyTheseLists&) = delete;
  OnlyTheseLists& operator=(const OnlyTheseLists&) = delete;

 private:
  NeighborDCH& neighbor_;
  int* plist_;
  int npair_;
};

NeighborDCH::NeighborDCH(Neighbor* retired, dch::lammps::SearchFactory factory)
    : Neighbor(*retired),
      retired_(retired),
      points_(lmp),
      images_(lmp),
      factory_(factory),
      special_(lmp),
      rules_(lmp),
      filler_(lmp, special_, rules_),
      cluster_filler_(lmp, special_, rules_),
      verifier_(lmp) {
  // Both objects hold the same arrays now; with this flag of the base class the old one's destructor frees
  // nothing.
  retired->*(&NeighborDCH::copymode) = 1;
}

NeighborDCH::~NeighborDCH() { show_bins(); }

NeighborDCH* NeighborDCH::install(LAMMPS* lammps, dch::lammps::SearchFactory factory) {
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
  auto* ours = new NeighborDCH(lammps->neighbor, factory);
  lammps->neighbor = ours;
  return ours;
}

void NeighborDCH::enable(double c) {
  enabled_ = true;
  c_ = c;
}

void NeighborDCH::disable() {
  enabled_ = false;
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
  Neighbor::init();
  const std::vector<dch::lammps::ListNote> before = std::exchange(notes_, {});
  run_ = {};
  before_run_ = {};
  clusters_ = std::exchange(requested_clusters_, {});
  notes_ = std::exchange(requested_notes_, {});
  if (!enabled_) {
    served_.clear();
    served_plist_.clear();
    if (clusters_.empty()) {
      tuner_.reset();
      return;
    }
  }
  rules_.copy_settings();
  if (enabled_) classify_lists();
  announce(before);
  if (served_.empty() && clusters_.empty()) {
    tuner_.reset();
    return;
  }
  prepare_search();
  prepare_skin();
  before_run_ = search_stats();
  hide_bins();
}

/// Whether a hierarchy for each class of sizes is worth its while. Cluster pairs come from a single one.
bool NeighborDCH::sizes_differ_much() const {
  constexpr double kRatio = 2;
  const bool any_by_radius =
      std::any_of(served_.begin(), served_.end(), [](const ServedList& served) { return served.by_radius; });
  if (!clusters_.empty()) return false;
  if (!any_by_radius) {
    for (int a = 1; a <= atom->ntypes; ++a) {
      const double own = std::sqrt(cutneighsq[a][a]);
      if (own > skin && cutneighmax > kRatio * own) return true;
    }
    return false;
  }
  if (atom->nlocal == 0) return false;
  const auto [least, most] = std::minmax_element(atom->radius, atom->radius + atom->nlocal);
  return *most > kRatio * *least;
}

void NeighborDCH::prepare_search() {
  const double radius = cutneighmax * kRadiusMargin;
  const bool by_size = sizes_differ_much();
  const int threads = pool_ ? pool_->threads() : 1;
  if (search_ && radius == params_.radius && c_ == params_.c && by_size == params_.size_classes &&
      threads == threads_)
    return;
  params_ = {};
  params_.radius = radius;
  params_.c = c_;
  params_.size_classes = by_size;
  search_.reset();
  try {
    if (threads != threads_) pool_ = threads_ > 1 ? dch::make_thread_pool(threads_) : nullptr;
    params_.executor = pool_.get();
    search_ = factory_(params_);
  } catch (const dch::Error& e) {
    error->all(FLERR, std::string("DCH neighbor lists: ") + e.what());
  }
}

// A smaller skin is as safe as a larger one only if every step asks whether atoms have moved by half of it.
// Native lists with cutoffs by radius know the script's skin only.
void NeighborDCH::prepare_skin() {
  const bool any_by_radius =
      std::any_of(served_.begin(), served_.end(), [](const ServedList& served) { return served.by_radius; });
  std::string obstacle;
  if (!dist_check) obstacle = "lists are rebuilt without a check (neigh_modify check no)";
  if (build_once) obstacle = "lists are built once (neigh_modify once yes)";
  if (any_by_radius) obstacle = "a granular list is in use";
  if (!native_plist_.empty()) obstacle = "a native list is in use";
  if (!(skin > 0)) obstacle = "it is 0";
  if (!tunes_skin_ || !obstacle.empty()) {
    if (tunes_skin_ && comm->me == 0) utils::logmesg(lmp, "DCH: the skin stays as it is: " + obstacle + "\n");
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

// The base class takes what the box has changed by from `skin`.
int NeighborDCH::check_distance() {
  if (!tuner_) return Neighbor::check_distance();
  const double of_script = std::exchange(skin, tuner_->skin());
  const int moved = Neighbor::check_distance();
  skin = of_script;
  return moved;
}

void NeighborDCH::classify_lists() {
  served_plist_.clear();
  native_plist_.clear();
  std::vector<ServedList> served;
  for (int k = 0; k < npair_perpetual; ++k) {
    const int m = plist[k];
    const NeighList& list = *lists[m];
    if (!native_reason(list).empty()) {
      native_plist_.push_back(m);
      continue;
    }
    const int mask = pairmasks[list.pair_method - 1];
    ServedList ours;
    ours.index = m;
    ours.full = (mask & NP_FULL) != 0;
    ours.newton = !ours.full && !(mask & NP_NEWTOFF);
    ours.ghost = list.ghost != 0;
    ours.by_radius = (mask & NP_SIZE) != 0;
    ours.history = ours.by_radius && list.history != 0;
    const auto old =
        std::find_if(served_.begin(), served_.end(), [&](const ServedList& s) { return s.index == m; });
    if (old != served_.end()) ours.rows = std::move(old->rows);
    served.push_back(std::move(ours));
    served_plist_.push_back(m);
  }
  served_ = std::move(served);
  for (int m = 0; m < nlist; ++m) {
    if (lists[m]->pair_method == 0) continue;
    notes_.push_back({m + 1, list_name(*lists[m]), native_reason(*lists[m])});
  }
}

std::string NeighborDCH::list_name(const NeighList& list) const {
  std::string owner = "parent of skip lists";
  if (list.requestor_type == NeighList::PAIR) {
    const char* keyword = force->pair_match_ptr(static_cast<Pair*>(list.requestor));
    owner = std::string("pair ") + (keyword ? keyword : "?");
  } else if (list.requestor_type == NeighList::FIX) {
    owner = std::string("fix ") + static_cast<Fix*>(list.requestor)->style;
  } else if (list.requestor_type == NeighList::COMPUTE) {
    owner = std::string("compute ") + static_cast<Compute*>(list.requestor)->style;
  }
  const int mask = pairmasks[list.pair_method - 1];
  const bool full = (mask & NP_FULL) != 0;
  if (full && (mask & NP_HALF)) return owner;  // a builder of derived lists, which takes either kind
  const std::string kind = full ? ", full" : mask & NP_NEWTOFF ? ", half, newton off" : ", half, newton on";
  return owner + kind + (list.ghost ? ", with ghost rows" : "");
}

std::string NeighborDCH::reason_of_style(const NeighList& list) const {
  const int mask = pairmasks[list.pair_method - 1];
  if (mask & NP_SIZE && !atom->radius_flag) return "cutoffs by radius, but atoms have none";
  if (mask & NP_RESPA) return "inner and middle levels of r-RESPA";
  if (mask & (NP_ONESIDE | NP_OFF2ON)) return "one-sided";
  if (mask & NP_BOND) return "bonds in the list";
  if (mask & (NP_SSA | NP_INTEL | NP_KOKKOS_DEVICE | NP_KOKKOS_HOST))
    return "layout of an accelerator package";
  if (mask & (NP_COPY | NP_SKIP | NP_HALF_FULL)) return "derived from another list";
  return {};
}

std::string NeighborDCH::native_reason(const NeighList& list) const {
  if (list.occasional) return "built on demand only";
  if (std::string from = derivation(list); !from.empty()) return from;
  if (std::string kind = reason_of_style(list); !kind.empty()) return kind;
  if (list.requestor_type == NeighList::FIX || list.requestor_type == NeighList::COMPUTE) {
    return "asked for by a " + std::string(list.requestor_type == NeighList::FIX ? "fix" : "compute") +
           ", maybe with a cutoff of its own";
  }
  if (force->pair_match("kim", 0) || force->pair_match("kim", 0, 1))
    return "pair kim sets cutoffs of its own";
  if (!atom->tag_enable) return "atoms have no IDs (atom_modify id no)";
  if (!(cutneighmax > 0)) return "no cutoff";
  if (list.ghost && includegroup) return "ghost rows with neigh_modify include";
  // No style of the packages that the adapter is tested with asks for one.
  if (list.ghost && !(pairmasks[list.pair_method - 1] & NP_FULL)) return "half list with ghost rows";
  if (list.ghost) {
    for (int a = 1; a <= atom->ntypes; ++a) {
      for (int b = 1; b <= atom->ntypes; ++b) {
        if (cutneighghostsq[a][b] > cutneighmaxsq) return "ghost cutoff beyond the largest cutoff";
      }
    }
  }
  return {};
}

std::shared_ptr<ClusterList> NeighborDCH::request_clusters(const std::string& style_name,
                                                           const std::string& obstacle) {
  const std::string owner = "pair " + style_name;
  if (!obstacle.empty()) {
    requested_notes_.push_back({0, owner + " without cluster pairs", obstacle});
    return nullptr;
  }
  auto clusters = std::make_shared<ClusterList>();
  const auto n = static_cast<std::size_t>(atom->ntypes);
  clusters->interacts.assign(n * n, 0);
  requested_clusters_.push_back(clusters);
  requested_notes_.push_back({0, owner + ", cluster pairs", {}});
  return clusters;
}

void NeighborDCH::announce(const std::vector<dch::lammps::ListNote>& before) const {
  if (notes_ == before || comm->me != 0) return;
  utils::logmesg(lmp, "DCH neighbor lists: " + std::to_string(served_.size() + clusters_.size()) + " of " +
                          std::to_string(notes_.size()) + " lists; 'dch stats' says which\n");
}

// setup_bins() is not virtual and runs outside build(): where bins are in sight stock code sizes them, and
// stops at large or sparse systems with "Too many neighbor bins", although nobody reads them.
void NeighborDCH::hide_bins() {
  for (int m = 0; m < nlist; ++m) {
    const bool ours = std::find(served_plist_.begin(), served_plist_.end(), m) != served_plist_.end();
    if (!ours && lists[m]->bin_method > 0) return;
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

// --------------------------------------------------------------------------------------------------------------------
// Building them

void NeighborDCH::build(int topoflag) {
  if (tuner_) choose_skin();
  if (!fills_lists()) {
    if (!clusters_.empty()) build_ours();
    Neighbor::build(topoflag);
    return;
  }
  const bool verify = verify_every_ > 0 && run_.builds % verify_every_ == 0;
  if (verify) build_native_reference();
  build_ours();
  if (verify) check_against_native();
  OnlyTheseLists rest(*this, native_plist_);
  Neighbor::build(topoflag);
}

void NeighborDCH::build_ours() {
  double clock = MPI_Wtime();
  try {
    points_.gather(may_use_box());
    if (points_.in_box() && fills_lists()) images_.gather(cutneighmax);
    run_.points_seconds += seconds_since(clock);
    search_->update(points_.positions(), points_.box(), points_.keys());
    run_.structure_seconds += seconds_since(clock);
    run_.entries = 0;
    if (fills_lists()) fill_lists();
    fill_clusters();
  } catch (const dch::Error& e) {
    error->one(FLERR, std::string("DCH neighbor lists: ") + e.what());
  } catch (const std::bad_alloc&) {
    error->one(FLERR, std::string("DCH neighbor lists: out of memory; use more processes or give 'dch off'"));
  }
  ++run_.builds;
}

void NeighborDCH::fill_lists() {
  double clock = MPI_Wtime();
  const ImageTest by_images(images_);
  for (ServedList& served : served_) {
    NeighList& list = *lists[served.index];
    dch::ListParams params = list_params(served);
    if (points_.in_box()) {
      images_.set_cutoffs(served.by_radius);
      params.near_cutoff = &by_images;
      params.exclusions = special_.never_seen(points_.size());
    }
    search_->list(params, served.rows);
    run_.rows_seconds += seconds_since(clock);
    list.grow(atom->nlocal, atom->nlocal + atom->nghost);
    filler_.fill(points_, images_, served, list);
    run_.entries += served.pairs;
    run_.fill_seconds += seconds_since(clock);
  }
}

void NeighborDCH::fill_clusters() {
  double clock = MPI_Wtime();
  for (const std::shared_ptr<ClusterList>& clusters : clusters_) {
    cluster_filler_.fill(points_, *dch::hierarchy_of(*search_), *clusters);
    run_.entries += clusters->pairs.slot_pairs();
    run_.clusters_seconds += seconds_since(clock);
  }
}

bool NeighborDCH::may_use_box() const {
  const bool any_ghost_rows =
      fills_lists() &&
      std::any_of(served_.begin(), served_.end(), [](const ServedList& served) { return served.ghost; });
  const bool is_exact = cutneighmax + images_.error_within(cutneighmax) <= params_.radius;
  return !any_ghost_rows && is_exact && points_.may_use_box(params_.radius);
}

dch::ListParams NeighborDCH::list_params(const ServedList& served) {
  dch::ListParams params;
  // A pair through a ghost is in both rows if newton is off.
  const bool in_both_rows = served.full || (points_.in_box() && !served.newton);
  params.kind = in_both_rows ? dch::ListKind::full : dch::ListKind::half;
  params.order = dch::RowOrder::by_structure;
  params.first_ghost = served.ghost || points_.in_box() ? -1 : points_.owned();
  params.cutoffs = dch::TypeCutoffs(cutneighmax);
  if (served.ghost) return params;
  if (cutneighmin == cutneighmax) params.cutoffs = dch::TypeCutoffs(std::sqrt(cutneighsq[1][1]));
  if (served.by_radius) {
    params.radii = points_.radii();
    params.skin = skin;
    if (params.radii.empty()) params.cutoffs = dch::TypeCutoffs(kSmallestCutoff);  // the box is still empty
    return params;
  }
  if (atom->ntypes > 1 && cutneighmin < cutneighmax) {
    params.cutoffs = type_cutoffs();
    params.types = points_.types();
  }
  return params;
}

dch::TypeCutoffs NeighborDCH::type_cutoffs() const {
  const int n = atom->ntypes;
  std::vector<double> matrix;
  for (int a = 1; a <= n; ++a) {
    for (int b = 1; b <= n; ++b) {
      const double cutoff = std::sqrt(std::max(cutneighsq[a][b], cutneighsq[b][a]));
      matrix.push_back(std::clamp(cutoff, kSmallestCutoff, cutneighmax));
    }
  }
  return dch::TypeCutoffs(n, std::move(matrix));
}

// --------------------------------------------------------------------------------------------------------------------
// Checking them

void NeighborDCH::build_native_reference() {
  const bool were_hidden = bins_hidden_;
  show_bins();
  if (style != NSQ) setup_bins();
  const bigint calls = ncalls;
  double clock = MPI_Wtime();
  {
    OnlyTheseLists ours(*this, served_plist_);
    Neighbor::build(0);
  }
  run_.verified_native_seconds += seconds_since(clock);
  ncalls = calls;
  if (were_hidden) hide_bins();
  native_entries_.clear();
  for (const ServedList& served : served_)
    native_entries_.push_back(ListVerifier::entries(*lists[served.index], served));
  run_.verified_dch_seconds -= run_.seconds();  // check_against_native() adds it again, this build included
}

void NeighborDCH::check_against_native() {
  run_.verified_dch_seconds += run_.seconds();
  for (std::size_t k = 0; k < served_.size(); ++k) {
    const NeighList& list = *lists[served_[k].index];
    std::vector<dch::lammps::ListEntry> ours = ListVerifier::entries(list, served_[k]);
    const std::string difference = verifier_.compare(std::move(native_entries_[k]), std::move(ours),
                                                     served_[k], images_.error_within(cutneighmax));
    if (difference.empty()) continue;
    error->all(FLERR, "dch verify: at step " + std::to_string(update->ntimestep) +
                          " the native and the DCH list (" + list_name(list) +
                          ") are not the same: " + difference +
                          ". Give 'dch off' to go on with native lists, and please report the script");
  }
  ++run_.verified_builds;
  run_.verified_entries += run_.entries;
}

// --------------------------------------------------------------------------------------------------------------------
// Saying what they did

dch::lammps::RunReport NeighborDCH::report() const {
  const dch::SearchStats now = search_stats();
  std::size_t bytes = now.memory_bytes;
  for (const ServedList& served : served_)
    bytes += (served.rows.j.capacity() + served.rows.particle.capacity()) * sizeof(std::int32_t) +
             served.rows.first.capacity() * sizeof(std::int64_t);
  for (const std::shared_ptr<ClusterList>& clusters : clusters_) bytes += clusters->pairs.memory_bytes();

  std::array<std::int64_t, 8> sums{run_.entries,
                                   run_.verified_entries,
                                   now.promotions - before_run_.promotions,
                                   now.demotions - before_run_.demotions,
                                   now.inserted - before_run_.inserted,
                                   now.removed - before_run_.removed,
                                   static_cast<std::int64_t>(bytes),
                                   atom->nlocal};
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_INT64_T, MPI_SUM, world);
  std::array<std::int64_t, 4> largest{now.builds - before_run_.builds, now.repairs - before_run_.repairs,
                                      now.levels, now.refreshes - before_run_.refreshes};
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(largest.size()), MPI_INT64_T, MPI_MAX, world);
  std::array<double, 7> times{run_.points_seconds,  run_.structure_seconds,       run_.rows_seconds,
                              run_.fill_seconds,    run_.verified_native_seconds, run_.verified_dch_seconds,
                              run_.clusters_seconds};
  MPI_Allreduce(MPI_IN_PLACE, times.data(), static_cast<int>(times.size()), MPI_DOUBLE, MPI_MAX, world);

  dch::lammps::RunReport report;
  report.enabled = enabled_;
  if (tuner_) report.skin = tuner_->skin();
  report.skin_settled = tuner_ && tuner_->settled();
  report.verify_every = verify_every_;
  report.processes = comm->nprocs;
  report.radius = params_.radius;
  report.in_box = points_.in_box();
  report.c = params_.c;
  report.counters = run_;
  report.counters.entries = sums[0];
  report.counters.verified_entries = sums[1];
  report.counters.points_seconds = times[0];
  report.counters.structure_seconds = times[1];
  report.counters.rows_seconds = times[2];
  report.counters.fill_seconds = times[3];
  report.counters.verified_native_seconds = times[4];
  report.counters.verified_dch_seconds = times[5];
  report.counters.clusters_seconds = times[6];
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
