// SPDX-License-Identifier: GPL-2.0-or-later
#include "ghost_images.h"

#include <algorithm>
#include <atom.h>
#include <cmath>
#include <domain.h>
#include <limits>
#include <neighbor.h>

namespace LAMMPS_NS {
void GhostImages::gather(double radius) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis)
    largest += std::abs(domain->boxlo_bound[axis]) + std::abs(domain->boxhi_bound[axis]);
  // Half an ulp for each of the additions that make a ghost or wrap a point, along three axes, and room.
  error_ = 16 * std::numeric_limits<double>::epsilon() * (largest + radius);
  const double reach = radius * (1 + 1e-9) + error_;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const bool open = !domain->periodicity[axis] || (axis == 2 && domain->dimension == 2);
    const double infinity = std::numeric_limits<double>::infinity();
    // The height of the cell is the inverse of the length of a row of the inverse matrix.
    const double* inverse = domain->h_inv;
    const double rows[3] = {std::hypot(inverse[0], inverse[5], inverse[4]),
                            std::hypot(inverse[1], inverse[3]), inverse[2]};
    const double below = domain->triclinic ? reach * rows[axis] : domain->boxlo[axis] + reach;
    const double above = domain->triclinic ? 1 - reach * rows[axis] : domain->boxhi[axis] - reach;
    low_[a] = open ? -infinity : below;
    high_[a] = open ? infinity : above;
  }
  positions_ = atom->nlocal > 0 ? reinterpret_cast<const dch::Vec3*>(atom->x[0]) : nullptr;
  has_one_limit_ = neighbor->cutneighmin == neighbor->cutneighmax;
  limit_ = neighbor->cutneighsq[1][1];
  list_ghosts();
}

void GhostImages::list_ghosts() {
  const int owned = atom->nlocal, ghosts = atom->nghost;
  if (tags_.size() != static_cast<std::size_t>(owned) || !std::equal(tags_.begin(), tags_.end(), atom->tag)) {
    tags_.assign(atom->tag, atom->tag + owned);
    by_tag_.reset(tags_.size());
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

bool GhostImages::is_inside(int i) const {
  const double* at = atom->x[i];
  double lamda[3];
  if (domain->triclinic) {
    domain->x2lamda(atom->x[i], lamda);
    at = lamda;
  }
  bool inside = true;
  for (std::size_t axis = 0; axis < 3; ++axis) inside &= at[axis] >= low_[axis] && at[axis] <= high_[axis];
  return inside;
}

}  // namespace LAMMPS_NS
