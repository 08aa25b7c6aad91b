// SPDX-License-Identifier: GPL-2.0-or-later
// A build of the lists: points, search, and what LAMMPS gets of them.
#include <algorithm>
#include <atom.h>
#include <cmath>
#include <error.h>
#include <force.h>
#include <neigh_list.h>
#include <new>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "neighbor_dch.h"
#include "neighbor_dch_only.h"

namespace LAMMPS_NS {

namespace {

// A pair of types without interaction has cutoff 0 in LAMMPS, which still lists coincident atoms.
constexpr double kMinCutoff = 1e-100;

double seconds_since(double& start) {
  const double now = MPI_Wtime();
  return now - std::exchange(start, now);
}

}  // namespace

void NeighborDCH::build(int topoflag) {
  show_cutoffs();
  note_expiry();
  if (tuner_) choose_skin();
  if (!fills_lists() && clusters_.empty()) {
    Neighbor::build(topoflag);
    return;
  }
  const bool verify = verifies_this_build();
  if (verify) build_native_reference();
  build_ours();
  if (verify) check_against_native();
  OnlyTheseLists rest(*this, fills_lists() ? native_plist_ : needed_plist_);
  Neighbor::build(topoflag);
}

void NeighborDCH::build_ours() {
  double clock = MPI_Wtime();
  try {
    widen_search();
    const bool in_box = may_use_box();
    if (!in_box || verifies_this_build()) sides_.gather();
    points_.gather(in_box, in_box ? GhostChoice() : ghosts_to_search());
    if (points_.in_box() && fills_lists()) images_.gather(reach());
    run_.points_seconds += seconds_since(clock);
    search_->update(points_.positions(), points_.box(), points_.keys());
    points_.forget_keys();
    run_.structure_seconds += seconds_since(clock);
    expiry_.remember(points_, wanted_pairs().by_radii, expiry_obstacle_.empty() && every == 1);
    run_.points_seconds += seconds_since(clock);
    run_.entries = 0;
    if (fills_lists()) fill_lists();
    fill_clusters();
    const bool follows_atoms =
        fills_lists() ? served_.front().has_short_rows : clusters_.back().list->has_whole_rows();
    if (run_.builds == 0 && follows_atoms) order_.note_short_rows();
  } catch (const dch::Error& e) {
    error->one(FLERR, std::string("DCH neighbor lists: ") + e.what());
  } catch (const std::bad_alloc&) {
    error->one(FLERR, std::string("DCH neighbor lists: out of memory; use more processes or give 'dch off'"));
  }
  ++run_.builds;
}

/// How far lists look. LAMMPS's largest cutoff leaves out pairs of frozen grains, and knows no radii that
/// grow in a run.
double NeighborDCH::reach() const {
  if (!any_by_radius()) return cutneighmax;
  const int atoms = atom->nlocal + atom->nghost;
  const double largest = atoms > 0 ? *std::max_element(atom->radius, atom->radius + atoms) : 0.0;
  return std::max(cutneighmax, 2 * largest + skin);
}

/// A search that no longer reaches far enough is made anew, with room for radii that go on growing.
void NeighborDCH::widen_search() {
  constexpr double kRoom = 1.1;
  if (reach() + images_.error_within(reach()) <= params_.radius) return;
  params_.radius = kRoom * reach();
  search_ = parts_.search(engine_in_use_, params_);
  before_run_ = {};
}

void NeighborDCH::fill_lists() {
  double clock = MPI_Wtime();
  const ImageTest by_images(images_);
  for (ServedList& served : served_) {
    NeighList& list = *lists[served.index];
    dch::ListParams params = list_params(served);
    if (points_.in_box()) {
      images_.set_cutoffs(served.by_radius);
      params.tie_breaker = &by_images;
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
  for (const ServedClusters& clusters : clusters_) {
    cluster_filler_->fill(points_, *search_, present_skin(), *clusters.list);
    clusters.list->pairs.order_entries(dch::LennardJones::wanted_order(precision_), executor());
    run_.clusters_seconds += seconds_since(clock);
  }
}

void NeighborDCH::order_atoms() {
  if (run_.builds == 0 || !order_.is_due()) return;
  const std::vector<std::int32_t>& points =
      fills_lists() ? served_.front().rows.particle : cluster_filler_->order(*clusters_.back().list);
  std::vector<std::int32_t> atoms;
  atoms.reserve(points.size());
  // With cluster pairs owned atoms are points of the same number; no ghost is put in order.
  for (const std::int32_t point : points)
    atoms.push_back(point < 0 || !fills_lists() ? point : points_.atom_of(point));
  stock_builds_.follow(order_.apply(atoms));
}

bool NeighborDCH::may_use_box() const {
  const bool any_ghost_rows =
      fills_lists() &&
      std::any_of(served_.begin(), served_.end(), [](const ServedList& served) { return served.ghost; });
  const bool is_exact = reach() + images_.error_within(reach()) <= params_.radius;
  // LAMMPS tells bonded atoms by image, and in a skewed box the nearest one may be a stranger to it.
  return !any_ghost_rows && is_exact && special_.are_near_ones() && points_.may_use_box(params_.radius);
}

/// Whether nobody asks for the pairs that other processes take.
bool NeighborDCH::leaves_ghosts_to_others() const {
  const bool all_newton =
      std::all_of(served_.begin(), served_.end(), [](const ServedList& s) { return s.newton; });
  return rules_.goes_by_side() && (!fills_lists() || all_newton) && (clusters_.empty() || force->newton_pair);
}

/// Whether LAMMPS has ghosts that are too far for pairs of their types, and nobody asks for what is around
/// these.
bool NeighborDCH::leaves_far_ghosts() const {
  constexpr int kManyTypes = 32;  // ghosts are compared with each
  const bool has_ghost_rows = fills_lists() && std::any_of(served_.begin(), served_.end(),
                                                           [](const ServedList& s) { return s.ghost; });
  return cutneighmin < cutneighmax && atom->ntypes <= kManyTypes && !any_by_radius() && !has_ghost_rows;
}

GhostChoice NeighborDCH::ghosts_to_search() {
  GhostChoice choice;
  if (leaves_ghosts_to_others()) choice.sides = &sides_;
  if (leaves_far_ghosts()) {
    reach_.gather();
    choice.reach = &reach_;
  }
  return choice;
}

dch::ListParams NeighborDCH::list_params(const ServedList& served) {
  dch::ListParams params;
  // A pair through a ghost is in both rows if newton is off.
  const bool in_both_rows = served.full || (points_.in_box() && !served.newton);
  params.kind = in_both_rows ? dch::ListKind::full : dch::ListKind::half;
  params.order = dch::RowOrder::unsorted;
  params.first_ghost = served.ghost || points_.in_box() ? -1 : points_.owned();
  params.cutoffs = dch::TypeCutoffs(cutneighmax);
  params.shell = present_skin();
  if (served.ghost) return params;
  if (cutneighmin == cutneighmax) params.cutoffs = dch::TypeCutoffs(std::sqrt(cutneighsq[1][1]));
  if (served.by_radius) {
    params.radii = points_.radii();
    params.skin = skin;
    if (params.radii.empty()) params.cutoffs = dch::TypeCutoffs(kMinCutoff);  // the box is still empty
    return params;
  }
  if (atom->ntypes > 1 && cutneighmin < cutneighmax) {
    params.cutoffs = type_cutoffs();
    params.types = points_.types();
  }
  return params;
}

double NeighborDCH::present_skin() const { return tuner_ ? tuner_->skin() : skin; }

dch::TypeCutoffs NeighborDCH::type_cutoffs() const {
  const int n = atom->ntypes;
  std::vector<double> matrix;
  for (int a = 1; a <= n; ++a) {
    for (int b = 1; b <= n; ++b) {
      const double cutoff = std::sqrt(std::max(cutneighsq[a][b], cutneighsq[b][a]));
      matrix.push_back(std::clamp(cutoff, kMinCutoff, cutneighmax));
    }
  }
  return dch::TypeCutoffs(n, std::move(matrix));
}

}  // namespace LAMMPS_NS
