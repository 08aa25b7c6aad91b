// SPDX-License-Identifier: GPL-2.0-or-later
#include "moving_atoms.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <domain.h>
#include <fix.h>
#include <force.h>
#include <limits>
#include <modify.h>

#include "id_numbers.h"

namespace LAMMPS_NS {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool holds_bonds(const char* style) {
  return std::strncmp(style, "shake", 5) == 0 || std::strncmp(style, "rattle", 6) == 0;
}

}  // namespace

void MovingAtoms::begin(const dch::lammps::BoxStep& step, int group_bit) {
  step_ = step;
  group_bit_ = group_bit;
  both_hold_ = !force->newton_bond;
  held_by_fix_ = std::any_of(modify->fix, modify->fix + modify->nfix,
                             [](const Fix* fix) { return holds_bonds(fix->style); });
  width_ = 0;
  const double limit = step.now().half_height();
  for (int i = 0; i < atom->nlocal; ++i) {
    const imageint image = atom->image[i];
    if (!pasts_.has(i)) {
      pasts_.move(i, {kNaN, kNaN, kNaN}, image);  // a bond to it that another atom holds is undetermined
      continue;
    }
    const imageint then = pasts_.image(i);
    dch::Vec3 start = pasts_.position(i);
    if (then != image || !step.same_basis()) start = step.start(start, box_counts(then), box_counts(image));
    const bool is_known = step.comparable() && step.moved2(start, now(i)) < limit * limit;
    pasts_.move(i, is_known ? start : dch::Vec3{kNaN, kNaN, kNaN}, image);
  }
}

void MovingAtoms::expect_ghosts(int bonds) {
  width_ = bonds;
  const auto ghosts = static_cast<std::size_t>(atom->nghost);
  ghosts_.resize(ghosts);
  bonds_.resize(ghosts * static_cast<std::size_t>(bonds));
}

void MovingAtoms::finish() {
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!in_group(i)) {
      pasts_.forget(i);
      continue;
    }
    pasts_.note(i, now(i), atom->image[i]);
    for (int m = 0; m < atom->num_bond[i]; ++m)
      if (is_bond(atom->bond_type[i][m])) pasts_.note_bond(i, atom->bond_atom[i][m]);
  }
}

int MovingAtoms::pack(int n, const int* list, double* to, bool through_faces, const int* faces) const {
  dch::Vec3 shift_before, shift_now;
  if (through_faces) {
    const dch::Vec3 count{static_cast<double>(faces[0]), static_cast<double>(faces[1]),
                          static_cast<double>(faces[2])};
    shift_before = step_.before().vector(count);
    shift_now = step_.now().vector(count);
  }
  double* at = to;
  for (int k = 0; k < n; ++k) {
    const int i = list[k];
    const dch::Vec3 start = before(i) + shift_before, end = now(i) + shift_now;
    for (int axis = 0; axis < 3; ++axis) *at++ = start[axis];
    for (int axis = 0; axis < 3; ++axis) *at++ = end[axis];
    double* const bonds = at;
    const auto write = [&](tagint partner, bool is_old) { *at++ = in_double(is_old ? partner : -partner); };
    if (i < atom->nlocal) {
      for_bonds_of_owned(i, write);
    } else {
      for_bonds_of_ghost(i, write);
    }
    at = std::fill_n(at, width_ - (at - bonds), 0.0);
  }
  return static_cast<int>(at - to);
}

void MovingAtoms::unpack(int n, int first, const double* from) {
  for (int i = first; i < first + n; ++i) {
    Ghost& ghost = ghosts_[place(i)];
    for (int axis = 0; axis < 3; ++axis) ghost.before[axis] = *from++;
    for (int axis = 0; axis < 3; ++axis) ghost.now[axis] = *from++;
    tagint* const held = bonds_.data() + place(i) * static_cast<std::size_t>(width_);
    for (int m = 0; m < width_; ++m) held[m] = from_double<tagint>(*from++);
  }
}

std::size_t MovingAtoms::bonds_held() const {
  std::size_t held = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if (in_group(i)) held += static_cast<std::size_t>(atom->num_bond[i]);
  if (both_hold_) held /= 2;
  if (!has_ghosts() || atom->nlocal == 0) return held;
  return held + held * ghosts_.size() / static_cast<std::size_t>(atom->nlocal);  // as many bonds an atom
}

int MovingAtoms::most_bonds() const {
  int most = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    int held = 0;
    for_bonds_of_owned(i, [&](tagint, bool) { ++held; });
    most = std::max(most, held);
  }
  return most;
}

double MovingAtoms::memory_bytes() const {
  return static_cast<double>(ghosts_.capacity() * sizeof(Ghost) + bonds_.capacity() * sizeof(tagint));
}

}  // namespace LAMMPS_NS
