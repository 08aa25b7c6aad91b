// SPDX-License-Identifier: GPL-2.0-or-later
#include "cluster_list.h"

#include <algorithm>
#include <atom.h>
#include <cmath>
#include <domain.h>
#include <force.h>
#include <neighbor.h>
#include <utility>

namespace LAMMPS_NS {
namespace {

double distance2(const double* a, const double* b) {
  return norm2(dch::Vec3{a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

}  // namespace

void ClusterList::take_types(const int* of_atoms, int types) {
  if (types == 1) return;
  if (taken_types.size() == atoms() && std::equal(taken_types.begin(), taken_types.end(), of_atoms)) return;
  taken_types.assign(of_atoms, of_atoms + atoms());
  for (std::size_t slot = 0; slot < pairs.particle.size(); ++slot)
    if (pairs.particle[slot] >= 0) pairs.type[slot] = of_atoms[pairs.particle[slot]] - 1;
  for (std::size_t i = 0; i < pair_list.type.size(); ++i) pair_list.type[i] = of_atoms[i] - 1;
  for (std::size_t k = 0; k < special.size(); ++k)
    special.types[k] = (of_atoms[special.i[k]] - 1) * types + of_atoms[special.j[k]] - 1;
}

dch::TypeCutoffs ClusterListFiller::cutoffs(const ClusterList& list) const {
  const int n = atom->ntypes;
  std::vector<double> matrix;
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      const bool wanted = list.pairs_interact(a + 1, b + 1, n);
      const double cutoff2 = std::max(neighbor->cutneighsq[a + 1][b + 1], neighbor->cutneighsq[b + 1][a + 1]);
      matrix.push_back(wanted ? std::min(std::sqrt(cutoff2), neighbor->cutneighmax) : 0.0);
    }
  }
  return dch::TypeCutoffs(n, std::move(matrix));
}

/// One image of a partner of owned atom i.
void ClusterListFiller::take_special_pair(const AtomPoints& points, int i, int image, int kind,
                                          ClusterList& list) {
  const bool is_ghost = image >= atom->nlocal;
  const int owner = points.in_box() && is_ghost ? atom->map(atom->tag[image]) : image;
  const std::int32_t point = points.point_of(owner);
  if (point < 0) return;  // another process takes the pair
  excluded_.push_back({i, point});
  const bool twice =
      !is_ghost || points.in_box() ? owner < i : force->newton_pair && !rules_.stored_here(i, image);
  if (kind < 0 || twice) return;
  const int a = atom->type[i], b = atom->type[image];
  const bool wanted = list.pairs_interact(a, b, atom->ntypes);
  if (wanted && !rules_.excluded(i, image) &&
      distance2(atom->x[i], atom->x[image]) <= neighbor->cutneighsq[a][b]) {
    list.special.i.push_back(i);
    list.special.j.push_back(owner);
    list.special.at.push_back(image);
    list.special.kind.push_back(kind);
    list.special.types.push_back((a - 1) * atom->ntypes + b - 1);
  }
}

/// Bonded pairs leave the cluster pairs; those to be weighted go into a list of their own. A bonded atom's
/// far image is no bonded atom, as in LAMMPS's lists.
void ClusterListFiller::take_special_pairs(const AtomPoints& points, ClusterList& list) {
  excluded_.clear();
  for (int i = 0; i < points.owned(); ++i) {
    for (int k = 0; k < atom->nspecial[i][2]; ++k) {
      for (int j = atom_with(*atom, atom->special[i][k]); j >= 0; j = atom->sametag[j]) {
        const double *xi = atom->x[i], *xj = atom->x[j];
        if (domain->minimum_image_check(xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2])) continue;
        if (const int kind = special_.kind(i, j); kind != 0) take_special_pair(points, i, j, kind, list);
      }
    }
  }
}

namespace {

/// As make_pair_list, row by row in the order of particles.
template <class Accept>
void make_whole_rows(const dch::NeighborList& rows, const dch::ListParams& params, AtomPoints& points,
                     const Accept& accept, dch::PairList& out) try {
  dch::detail::PairListMaker maker(rows, params.list_radius(), points.positions(), points.box(), params.types,
                                   out);
  std::vector<std::size_t> row_of(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r)
    row_of[rows.particle.empty() ? r : static_cast<std::size_t>(rows.particle[r])] = r;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::int64_t k = rows.first[row_of[i]]; k < rows.first[row_of[i] + 1]; ++k) {
      const auto p = static_cast<std::int32_t>(i), q = rows.j[static_cast<std::size_t>(k)];
      maker.add(p, q, accept(p, q));
    }
  }
  maker.finish();
} catch (...) {
  out = dch::PairList();
  throw;
}

}  // namespace

/// Rows of pairs are of owned atoms, which are points of the same number.
void ClusterListFiller::fill_pair_list(AtomPoints& points, dch::PairSearch& search, dch::ListParams params,
                                       double skin, ClusterList& list) {
  params.order = dch::RowOrder::unsorted;
  params.superset = true;
  if (!list.has_whole_rows()) params.shell = skin;
  search.list(params, rows_);
  const auto make = [&](const auto& accept) {
    if (list.has_whole_rows()) {
      make_whole_rows(rows_, params, points, accept, list.pair_list);
    } else {
      dch::make_pair_list(rows_, params.list_radius(), points.positions(), points.box(), params.types, accept,
                          list.pair_list);
    }
  };
  const bool asks_bonds = params.exclusions == nullptr && !points.in_box() && atom->molecular != Atom::ATOMIC;
  const bool asks_rules = rules_.excludes_any() || takes_turns(points);
  if (!asks_bonds && !asks_rules) {
    make([](std::int32_t, std::int32_t) { return true; });
  } else {
    const SpecialPairs::Marks* const marks = asks_bonds ? &special_.take_marks() : nullptr;
    const bool any_marked = marks != nullptr && marks->any();
    make([&](std::int32_t i, std::int32_t point) {
      const bool is_bonded =
          any_marked && marks->of(i, atom->tag[points.atom_of(point)]) == SpecialPairs::Marks::kInNoList;
      return !is_bonded & !(asks_rules && is_left_out(points, i, point));
    });
  }
  name_atoms(points, list.pair_list);
}

/// What the search is to leave out, for pairs of bonded atoms.
const dch::Exclusions* ClusterListFiller::bonded_pairs(const AtomPoints& points, bool by_pairs,
                                                       ClusterList& list) {
  list.special.clear();
  if (atom->molecular == Atom::ATOMIC) return nullptr;
  const bool any_marked = special_.any_marked();
  if (points.in_box() && !any_marked) return special_.never_seen(points.owned());
  // Exclusions would have to be made anew at every build, since atoms migrate: pairs are asked one by one.
  if (by_pairs && !any_marked && special_.are_near_ones()) return nullptr;
  take_special_pairs(points, list);
  exclusions_ = dch::Exclusions::from_pairs(static_cast<std::size_t>(points.size()), excluded_);
  return &exclusions_;
}

void ClusterListFiller::fill(AtomPoints& points, dch::PairSearch& search, double skin, ClusterList& list) {
  list.in_box = points.in_box();
  list.taken_types.clear();
  dch::ListParams params;
  params.cutoffs = cutoffs(list);
  params.first_ghost = points.in_box() ? -1 : points.owned();
  if (atom->ntypes > 1) params.types = points.types();
  list.by_size = !search.has_cluster_pairs();
  // `dch skin auto` changes the radius.
  const bool chooses = std::exchange(list.chosen_for, params.list_radius()) != params.list_radius();
  const bool by_pairs = list.by_size || (list.one_by_one && !chooses);
  params.exclusions = bonded_pairs(points, by_pairs, list);
  if (by_pairs) {
    list.one_by_one = true;
    fill_pair_list(points, search, params, skin, list);
    return;
  }
  search.cluster_pairs(params, list.pairs);
  leave_out(points, list.pairs);
  if (chooses) choose_kind(points, search, skin, params, list);
  if (!list.one_by_one) name_atoms(points, list.pairs);
}

/// Whichever is not taken gives its memory back: pairs one by one take several times that of cluster pairs.
void ClusterListFiller::choose_kind(AtomPoints& points, dch::PairSearch& search, double skin,
                                    const dch::ListParams& params, ClusterList& list) {
  list.pairs_an_atom = static_cast<double>(pairs_within(params, list.pairs)) / std::max(points.owned(), 1);
  list.one_by_one = list.pairs_an_atom <= ClusterList::kFewNeighbors;
  if (list.one_by_one) {
    list.pairs = {};
    fill_pair_list(points, search, params, skin, list);
  } else {
    list.pair_list = {};
    rows_ = {};
  }
}

/// Pairs that a list with these cutoffs holds, of which cluster pairs hold more.
std::int64_t ClusterListFiller::pairs_within(const dch::ListParams& params, const dch::ClusterPairs& pairs) {
  std::int64_t count = 0;
  pairs.for_each([&](std::int32_t i, std::int32_t j, dch::Vec3 from_i_to_j) {
    const double cutoff = params.types.empty() ? params.cutoffs(0, 0)
                                               : params.cutoffs(params.types[static_cast<std::size_t>(i)],
                                                                params.types[static_cast<std::size_t>(j)]);
    count += norm2(from_i_to_j) <= cutoff * cutoff ? 1 : 0;
  });
  return count;
}

}  // namespace LAMMPS_NS
