// SPDX-License-Identifier: GPL-2.0-or-later
#include "ghost_images.h"

#include <algorithm>
#include <array>
#include <atom.h>
#include <cmath>
#include <domain.h>
#include <limits>
#include <neighbor.h>

namespace LAMMPS_NS {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// In two dimensions LAMMPS makes no ghosts along z.
bool has_ghosts_along(const Domain& domain, int axis) {
  return domain.periodicity[axis] != 0 && (axis < 2 || domain.dimension == 3);
}

}  // namespace

/// Half an ulp for each of the additions that make a ghost or wrap a point, along three axes, and room.
double GhostImages::error_within(double radius) const {
  double largest = radius;
  for (int axis = 0; axis < 3; ++axis) {
    if (domain->triclinic) {
      largest += std::abs(domain->boxlo_bound[axis]) + std::abs(domain->boxhi_bound[axis]);
    } else if (has_ghosts_along(*domain, axis)) {
      largest += std::abs(domain->boxlo[axis]) + std::abs(domain->boxhi[axis]);
    }
  }
  return 16 * std::numeric_limits<double>::epsilon() * largest;
}

void GhostImages::gather(double radius) {
  error_ = error_within(radius);
  positions_ = atom->nlocal > 0 ? reinterpret_cast<const dch::Vec3*>(atom->x[0]) : nullptr;
  is_skewed_ = domain->triclinic != 0;
  set_inside(radius * (1 + 1e-9) + 2 * error_);
  list_ghosts();
}

void GhostImages::set_cutoffs(bool by_radius) {
  by_radius_ = by_radius;
  has_one_limit_ = !by_radius && neighbor->cutneighmin == neighbor->cutneighmax;
  limit_ = neighbor->cutneighsq[1][1];
}

/// Atoms are inside if they are farther than `reach` from all faces through which there are ghosts.
void GhostImages::set_inside(double reach) {
  // The height of the cell along an axis is the inverse of the length of that row of the inverse matrix.
  const double* h = domain->h_inv;
  const std::array<double, 3> in_lamda{std::hypot(h[0], h[5], h[4]), std::hypot(h[1], h[3]), h[2]};
  dch::Vec3 low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const bool open = !has_ghosts_along(*domain, axis);
    low[axis] = open ? -kInfinity : domain->triclinic ? 0 : domain->boxlo[axis];
    high[axis] = open ? kInfinity : domain->triclinic ? 1 : domain->boxhi[axis];
  }
  const auto widen = [&](double length) {
    for (int axis = 0; axis < 3; ++axis) {
      const double by = domain->triclinic ? length * in_lamda[static_cast<std::size_t>(axis)] : length;
      low_[axis] = low[axis] - by;
      high_[axis] = high[axis] + by;
    }
  };
  // LAMMPS wraps atoms into the box before it makes ghosts. Were one outside, others might be near its image.
  widen(error_);
  for (int i = 0; i < atom->nlocal; ++i) {
    if (is_inside(i)) continue;
    low_ = {kInfinity, kInfinity, kInfinity};
    return;
  }
  widen(-reach);
}

void GhostImages::list_ghosts() {
  const int owned = atom->nlocal, ghosts = atom->nghost;
  if (tags_.size() != static_cast<std::size_t>(owned) || !std::equal(tags_.begin(), tags_.end(), atom->tag)) {
    tags_.assign(atom->tag, atom->tag + owned);
    by_tag_.reset(tags_.size(), tags_.empty() ? 0 : *std::max_element(tags_.begin(), tags_.end()));
    for (int i = 0; i < owned; ++i) by_tag_.find_or_add(atom->tag[i], i);
  }
  owner_.resize(static_cast<std::size_t>(ghosts));
  first_.assign(static_cast<std::size_t>(owned) + 1, 0);
  for (int g = 0; g < ghosts; ++g) {
    const int i = by_tag_.find(atom->tag[owned + g]);
    owner_[static_cast<std::size_t>(g)] = i;
    if (i >= 0) ++first_[static_cast<std::size_t>(i) + 1];
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(owned); ++i) first_[i + 1] += first_[i];
  ghost_.resize(static_cast<std::size_t>(first_.back()));
  // Filled from the end of each row, which moves its end to its beginning.
  for (int g = ghosts - 1; g >= 0; --g) {
    const int i = owner_[static_cast<std::size_t>(g)];
    if (i >= 0) ghost_[static_cast<std::size_t>(--first_[static_cast<std::size_t>(i) + 1])] = owned + g;
  }
  for (std::size_t i = 0; i + 1 < first_.size(); ++i) first_[i] = first_[i + 1];
  first_.back() = static_cast<int>(ghost_.size());
}

double GhostImages::limit_of(int i, int j) const {
  if (by_radius_) {
    const double reach = atom->radius[i] + atom->radius[j] + neighbor->skin;
    return reach * reach;
  }
  return neighbor->cutneighsq[atom->type[i]][atom->type[j]];
}

int GhostImages::ghost_within(int i, int j, double limit) const {
  const auto row = static_cast<std::size_t>(j);
  for (int k = first_[row]; k < first_[row + 1]; ++k) {
    const int ghost = ghost_[static_cast<std::size_t>(k)];
    if (distance2(i, ghost) <= limit) return ghost;
  }
  return -1;
}

/// In the coordinates of the box.
dch::Vec3 GhostImages::lamda(int i) const {
  double at[3];
  domain->x2lamda(atom->x[i], at);
  return {at[0], at[1], at[2]};
}

}  // namespace LAMMPS_NS
