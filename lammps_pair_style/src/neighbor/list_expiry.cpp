// SPDX-License-Identifier: GPL-2.0-or-later
#include "list_expiry.h"

#include <algorithm>
#include <atom.h>
#include <cmath>
#include <comm.h>
#include <domain.h>
#include <neighbor.h>
#include <utility>

#include <dch/engines/verlet_list.hpp>

namespace LAMMPS_NS {
namespace {

constexpr double kLeastMost = 16;  ///< of few atoms all may be asked about

double distance2(const double* a, const double* b) {
  return norm2(dch::Vec3{a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

/// Lengths in the coordinates of the cell: the height of the cell along an axis is the inverse of the length
/// of that row of the inverse matrix.
double scale_along(const Domain& domain, int axis) {
  if (!domain.triclinic) return 1;
  const double* h = domain.h_inv;
  return axis == 0 ? std::hypot(h[0], h[5], h[4]) : axis == 1 ? std::hypot(h[1], h[3]) : h[2];
}

}  // namespace

std::array<double, 9> ListExpiry::box_now() const {
  const double *low = domain->boxlo, *high = domain->boxhi;
  return {low[0], low[1], low[2], high[0], high[1], high[2], domain->xy, domain->xz, domain->yz};
}

void ListExpiry::remember(const AtomPoints& points, bool by_radii, bool may_be_asked) {
  points_ = -1;
  if (!may_be_asked) return;
  box_ = box_now();
  points_ = points.size();
  remember_left_out(points.ghosts_left_out());
  traits_.remember(by_radii);
}

bool ListExpiry::has_changed(const AtomPoints& points) const {
  return points.size() != points_ || box_now() != box_ || traits_.have_changed();
}

/// Whether a pair that is listed in one image cannot come within its cutoff in another one, before one of its
/// atoms has moved by more than the skin. Ghosts that are points are told apart anyway.
bool ListExpiry::keeps_images(const AtomPoints& points, const Wanted& wanted) const {
  constexpr double kSafe = 1 - 1e-9;
  if (!points.in_box()) return true;
  const dch::Box box = points.box();
  return !box.any_periodic() || kSafe * box.max_cutoff() >= neighbor->cutneighmax + 0.5 * wanted.skin;
}

/// A skin that is less by rounding: what LAMMPS may have left out at the end of it counts as left out.
ListExpiry::Verdict ListExpiry::find_fast(const AtomPoints& points, const double* const* before,
                                          const Wanted& wanted) {
  const double allowed = 0.5 * wanted.skin - 3 * wanted.rounding, allowed2 = allowed * allowed;
  if (!(allowed > 0)) return Verdict::cannot_tell;
  const auto most =
      static_cast<std::size_t>(std::max(kLeastMost, dch::kMostFast * static_cast<double>(points.owned())));
  fast_.clear();
  for (int p = 0; p < points.owned(); ++p) {
    const double moved2 = distance2(atom->x[points.atom_of(p)], before[points.atom_of(p)]);
    if (moved2 <= allowed2) continue;
    const double moved = std::sqrt(moved2) + wanted.rounding;
    if (!(moved <= wanted.skin)) return Verdict::too_far;
    if (fast_.size() == most) return Verdict::too_many;
    fast_.push_back({p, moved});
  }
  return Verdict::kept;
}

/// Whether there are no atoms on that side of this process's part of the box.
bool ListExpiry::is_open(int axis, bool high) const {
  if (axis == 2 && domain->dimension == 2) return true;
  if (domain->periodicity[axis]) return false;
  if (domain->triclinic) return high ? domain->subhi_lamda[axis] == 1 : domain->sublo_lamda[axis] == 0;
  return high ? domain->subhi[axis] == domain->boxhi[axis] : domain->sublo[axis] == domain->boxlo[axis];
}

/// Whether a place is in this process's part of the box, or beyond it by that at most, and all within `reach`
/// of it; beyond faces where there are no atoms anyway.
bool ListExpiry::is_inside(const double* at, double reach, const double* beyond) const {
  const bool skewed = domain->triclinic != 0;
  double here[3] = {at[0], at[1], at[2]}, place[3] = {at[0], at[1], at[2]};
  if (skewed) domain->x2lamda(here, place);
  const double *low = skewed ? domain->sublo_lamda : domain->sublo,
               *high = skewed ? domain->subhi_lamda : domain->subhi;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = reach * scale_along(*domain, axis);
    if (!is_open(axis, false) && place[axis] - length < low[axis] - beyond[axis]) return false;
    if (!is_open(axis, true) && place[axis] + length > high[axis] + beyond[axis]) return false;
  }
  return true;
}

/// Whether all atoms within their cutoffs of the fast ones were known here, as points or as ghosts that were
/// left out: owned ones, and ghosts, which LAMMPS sends up to Comm::cutghost around this process's part of
/// the box.
bool ListExpiry::all_see(const AtomPoints& points, const Wanted& wanted) const {
  constexpr double kNothing[3] = {0, 0, 0};
  const double cutoff = neighbor->cutneighmax - wanted.skin + 2 * wanted.rounding;
  return std::all_of(fast_.begin(), fast_.end(), [&](const dch::MovedParticle& fast) {
    const double* const at = atom->x[points.atom_of(fast.particle)];
    if (wanted.stays_near && !is_inside(at, -0.5 * wanted.skin, kNothing)) return false;
    return points.in_box() || is_inside(at, cutoff + fast.moved, comm->cutghost);
  });
}

/// That of the lists without its skin, wider by rounding; negative where types do not interact.
double ListExpiry::cutoff_by_types(int a, int b, const Wanted& wanted) const {
  const double with_skin = std::sqrt(std::max(neighbor->cutneighsq[a][b], neighbor->cutneighsq[b][a]));
  return wanted.by_types && with_skin > wanted.skin ? with_skin - wanted.skin + wanted.rounding : -1;
}

dch::TypeCutoffs ListExpiry::force_cutoffs(const Wanted& wanted) const {
  const int n = atom->ntypes;
  std::vector<double> matrix;
  for (int a = 1; a <= n; ++a) {
    for (int b = 1; b <= n; ++b) matrix.push_back(std::max(cutoff_by_types(a, b, wanted), 0.0));
  }
  return dch::TypeCutoffs(n, std::move(matrix));
}

dch::UnlistedPair ListExpiry::ask(AtomPoints& points, dch::PairSearch& search, const Wanted& wanted) {
  const dch::Span<const dch::Vec3> now = points.present_positions();
  dch::ListParams params;
  params.skin = wanted.skin - 4 * wanted.rounding;
  dch::UnlistedPair answer = dch::UnlistedPair::none;
  if (wanted.by_types) {
    params.cutoffs = force_cutoffs(wanted);
    if (atom->ntypes > 1) params.types = points.types();
    answer = search.unlisted_pair({params, {}, now, fast_});
  }
  if (wanted.by_radii && answer == dch::UnlistedPair::none) {
    params.radii = points.radii();
    answer = search.unlisted_pair({params, dch::RadiusRange(params.radii), now, fast_});
  }
  return answer;
}

void ListExpiry::remember_left_out(dch::Span<const int> ghosts) {
  left_out_.clear();
  std::vector<std::vector<int>> of_type(static_cast<std::size_t>(atom->ntypes) + 1);
  for (const int ghost : ghosts) of_type[static_cast<std::size_t>(atom->type[ghost])].push_back(ghost);
  for (int type = 1; type <= atom->ntypes; ++type) {
    const std::vector<int>& same = of_type[static_cast<std::size_t>(type)];
    if (!same.empty()) left_out_.emplace_back(type, same, atom->x);
  }
}

/// Whether the pair of an atom and a ghost is within its cutoff and was in no list.
/// @param then2  squared distance at the build
bool ListExpiry::is_missing(int i, int ghost, double then2, const Wanted& wanted) const {
  const double now2 = distance2(atom->x[i], atom->x[ghost]);
  const auto is_missing_of = [&](double cutoff) {
    const double listed = cutoff + wanted.skin - 4 * wanted.rounding;
    return cutoff >= 0 && now2 <= cutoff * cutoff && then2 > listed * listed;
  };
  return is_missing_of(cutoff_by_types(atom->type[i], atom->type[ghost], wanted)) ||
         (wanted.by_radii && is_missing_of(atom->radius[i] + atom->radius[ghost] + wanted.rounding));
}

/// The same of an atom that is fast and of all ghosts that were no points.
bool ListExpiry::lacks_ghost(int i, double moved, const double* before, const Wanted& wanted) const {
  constexpr double kNothing[3] = {0, 0, 0};
  const double largest = neighbor->cutneighmax - wanted.skin + 2 * wanted.rounding;
  if (is_inside(atom->x[i], largest + moved, kNothing)) return false;
  const dch::Vec3 place{atom->x[i][0], atom->x[i][1], atom->x[i][2]}, then{before[0], before[1], before[2]};
  return std::any_of(left_out_.begin(), left_out_.end(), [&](const GhostsLeftOut& ghosts) {
    const double cutoff = wanted.by_radii ? largest : cutoff_by_types(atom->type[i], ghosts.type(), wanted);
    return cutoff >= 0 && ghosts.any_near(place, cutoff + moved, [&](int ghost, dch::Vec3 ghost_then) {
      return is_missing(i, ghost, norm2(ghost_then - then), wanted);
    });
  });
}

ListExpiry::Verdict ListExpiry::judge(AtomPoints& points, dch::PairSearch& search,
                                      const double* const* before, const Wanted& wanted) {
  if (has_changed(points) || !keeps_images(points, wanted)) return Verdict::cannot_tell;
  if (const Verdict verdict = find_fast(points, before, wanted); verdict != Verdict::kept) return verdict;
  if (fast_.empty()) return Verdict::kept;
  if (!points.in_box() && comm->mode != Comm::SINGLE) return Verdict::cannot_tell;
  if (!all_see(points, wanted)) return Verdict::near_end;
  const bool lacks_any = std::any_of(fast_.begin(), fast_.end(), [&](const dch::MovedParticle& fast) {
    const int i = points.atom_of(fast.particle);
    return lacks_ghost(i, fast.moved, before[i], wanted);
  });
  if (lacks_any) return Verdict::pair_missing;
  const dch::UnlistedPair answer = ask(points, search, wanted);
  if (answer == dch::UnlistedPair::none) return Verdict::kept;
  return answer == dch::UnlistedPair::found ? Verdict::pair_missing : Verdict::cannot_tell;
}

bool ListExpiry::any_outside() const {
  if (domain->nonperiodic == 0) return false;
  for (int i = 0; i < atom->nlocal; ++i)
    if (!domain->inside_nonperiodic(atom->x[i])) return true;
  return false;
}

}  // namespace LAMMPS_NS
