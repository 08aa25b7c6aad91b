// SPDX-License-Identifier: GPL-2.0-or-later
#include "traits_at_build.h"

#include <algorithm>
#include <atom.h>
#include <cstring>
#include <force.h>
#include <neighbor.h>

namespace LAMMPS_NS {
namespace {

template <class T>
void take(std::vector<T>& taken, bool wanted, const T* values, int count) {
  taken.clear();
  if (wanted) taken.assign(values, values + count);
}

template <class T>
bool differ(const std::vector<T>& then, const T* now) {
  return !std::equal(then.begin(), then.end(), now);
}

}  // namespace

bool TraitsAtBuild::go_by_types() const {
  if (atom->ntypes == 1) return false;
  return neighbor->cutneighmin < neighbor->cutneighmax || neighbor->nex_type > 0 ||
         std::strncmp(force->pair_style, "hybrid", 6) == 0;
}

int TraitsAtBuild::groups_in_use() const {
  int bits = 0;
  for (int m = 0; m < neighbor->nex_group; ++m) bits |= neighbor->ex1_bit[m] | neighbor->ex2_bit[m];
  for (int m = 0; m < neighbor->nex_mol; ++m) bits |= neighbor->ex_mol_bit[m];
  return bits;
}

void TraitsAtBuild::remember(bool by_radii) {
  atoms_ = atom->nlocal;
  groups_ = groups_in_use();
  take(types_, go_by_types(), atom->type, atoms_);
  take(masks_, groups_ != 0, atom->mask, atoms_);
  take(molecules_, neighbor->nex_mol > 0, atom->molecule, atoms_);
  take(radii_, by_radii, atom->radius, atoms_);
}

bool TraitsAtBuild::have_changed() const {
  if (atom->nlocal != atoms_) return true;
  const auto is_in_same_groups = [this](int then, int now) { return ((then ^ now) & groups_) == 0; };
  return differ(types_, atom->type) || differ(molecules_, atom->molecule) || differ(radii_, atom->radius) ||
         !std::equal(masks_.begin(), masks_.end(), atom->mask, is_in_same_groups);
}

}  // namespace LAMMPS_NS
