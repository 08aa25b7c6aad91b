// SPDX-License-Identifier: GPL-2.0-or-later
#include "special_pairs.h"

#include <algorithm>
#include <atom.h>
#include <domain.h>
#include <neighbor.h>

namespace LAMMPS_NS {

bool SpecialPairs::any_marked() const {
  const int* flag = neighbor->special_flag;
  return atom->molecular != Atom::ATOMIC && (flag[1] == 2 || flag[2] == 2 || flag[3] == 2);
}

int SpecialPairs::kind(int i, int j) const {
  const tagint* partners = atom->special[i];
  const int* last = atom->nspecial[i];  // cumulative: ends of the 1-2, 1-3 and 1-4 partners
  const tagint tag = atom->tag[j];
  for (int k = 0; k < last[2]; ++k) {
    if (partners[k] != tag) continue;
    const int kind = k < last[0] ? 1 : k < last[1] ? 2 : 3;
    const int flag = neighbor->special_flag[kind];
    return flag == 0 ? -1 : flag == 1 ? 0 : kind;
  }
  return 0;
}

const SpecialPairs::Marks& SpecialPairs::take_marks() {
  marks_.partner_.clear();
  if (atom->molecular == Atom::ATOMIC) return marks_;
  int mark_of[4] = {};
  for (int kind = 1; kind < 4; ++kind) {
    const int flag = neighbor->special_flag[kind];
    mark_of[kind] = flag == 0 ? Marks::kInNoList : flag == 1 ? 0 : kind << SBBITS;
  }
  marks_.first_.resize(static_cast<std::size_t>(atom->nlocal) + 1);
  for (int i = 0; i < atom->nlocal; ++i) {
    marks_.first_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(marks_.partner_.size());
    const int* const end = atom->nspecial[i];
    for (int kind = 3; kind > 0; --kind) {
      if (mark_of[kind] == 0) continue;
      for (int k = kind == 1 ? 0 : end[kind - 2]; k < end[kind - 1]; ++k)
        marks_.partner_.push_back({atom->special[i][k], mark_of[kind]});
    }
    while (marks_.partner_.size() % Marks::kAtOnce != 0) marks_.partner_.push_back({});
  }
  marks_.first_.back() = static_cast<std::int32_t>(marks_.partner_.size());
  return marks_;
}

bool SpecialPairs::are_near_ones() const {
  const double reach = neighbor->cutneighmax * (1 + 1e-9);
  const auto is_wide = [&](int periodic, double half) { return !periodic || reach <= half; };
  return atom->molecular == Atom::ATOMIC ||
         (is_wide(domain->xperiodic, domain->xprd_half) && is_wide(domain->yperiodic, domain->yprd_half) &&
          is_wide(domain->zperiodic, domain->zprd_half));
}

/// Compares the topology with the one that is kept, and keeps it.
bool SpecialPairs::are_as_before(int count) {
  bool same = tags_.size() == static_cast<std::size_t>(count) &&
              std::equal(tags_.begin(), tags_.end(), atom->tag) &&
              std::equal(flags_ + 1, flags_ + 4, neighbor->special_flag + 1);
  std::size_t at = 0;
  for (int i = 0; same && i < count; ++i) {
    const int* ends = atom->nspecial[i];
    same = std::equal(ends, ends + 3, ends_.begin() + 3 * std::ptrdiff_t{i}) &&
           std::equal(atom->special[i], atom->special[i] + ends[2],
                      partners_.begin() + static_cast<std::ptrdiff_t>(at));
    at += static_cast<std::size_t>(ends[2]);
  }
  if (same) return true;
  tags_.assign(atom->tag, atom->tag + count);
  std::copy_n(neighbor->special_flag + 1, 3, flags_ + 1);
  partners_.clear();
  ends_.clear();
  for (int i = 0; i < count; ++i) {
    ends_.insert(ends_.end(), atom->nspecial[i], atom->nspecial[i] + 3);
    partners_.insert(partners_.end(), atom->special[i], atom->special[i] + atom->nspecial[i][2]);
  }
  return false;
}

const dch::Exclusions* SpecialPairs::never_seen(int count) {
  const int* flag = neighbor->special_flag;
  if (atom->molecular == Atom::ATOMIC || (flag[1] != 0 && flag[2] != 0 && flag[3] != 0)) return nullptr;
  if (!are_as_before(count)) {
    std::vector<dch::IndexPair> pairs;
    for (int i = 0; i < count; ++i) {
      const int* last = atom->nspecial[i];
      for (int k = 0; k < last[2]; ++k) {
        if (flag[k < last[0] ? 1 : k < last[1] ? 2 : 3] != 0) continue;
        const int j = atom_with(*atom, atom->special[i][k]);
        if (j > i && j < count) pairs.push_back({i, j});
      }
    }
    exclusions_ = dch::Exclusions::from_pairs(static_cast<std::size_t>(count), pairs);
  }
  return &exclusions_;
}

}  // namespace LAMMPS_NS
