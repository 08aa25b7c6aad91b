// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_rules.h"

#include <algorithm>
#include <atom.h>
#include <comm.h>
#include <neighbor.h>

#include "ghosts_sent.h"

namespace LAMMPS_NS {

void PairRules::copy_settings() {
  excludes_any_ = neighbor->exclude != 0;
  stride_ = atom->ntypes + 1;
  types_.assign(neighbor->nex_type > 0 ? static_cast<std::size_t>(stride_) * stride_ : 0, 0);
  for (int a = 1; a < stride_ && !types_.empty(); ++a) {
    for (int b = 1; b < stride_; ++b) {
      types_[static_cast<std::size_t>(a) * stride_ + b] = neighbor->ex_type[a][b] != 0 ? 1 : 0;
    }
  }
  groups_.clear();
  for (int m = 0; m < neighbor->nex_group; ++m)
    groups_.push_back({neighbor->ex1_bit[m], neighbor->ex2_bit[m]});
  molecules_.clear();
  for (int m = 0; m < neighbor->nex_mol; ++m) {
    molecules_.push_back({neighbor->ex_mol_bit[m], neighbor->ex_mol_intra[m] != 0});
  }
}

bool PairRules::excluded(int i, int j) const {
  if (!types_.empty() && types_[static_cast<std::size_t>(atom->type[i]) * stride_ + atom->type[j]])
    return true;
  const int mask_i = atom->mask[i], mask_j = atom->mask[j];
  for (const GroupPair& g : groups_) {
    if ((mask_i & g.bit1 && mask_j & g.bit2) || (mask_i & g.bit2 && mask_j & g.bit1)) return true;
  }
  return std::any_of(molecules_.begin(), molecules_.end(), [&](const Molecules& m) {
    return mask_i & m.bit && mask_j & m.bit && (atom->molecule[i] == atom->molecule[j]) == m.intra;
  });
}

bool PairRules::goes_by_side() const { return !GhostsSent::on_one_side(*comm); }

// With comm_modify mode multi and reduce/multi a process may have no ghost of a smaller atom where the larger
// one's owner has: the owner of the smaller takes the pair.
bool PairRules::stored_here(int i, int ghost) const {
  if (!goes_by_side()) {
    const auto own_cutoff2 = [&](int k) {
      const int c = neighbor->collection[k];
      return neighbor->cutcollectionsq[c][c];
    };
    const double at_i = own_cutoff2(i), at_ghost = own_cutoff2(ghost);
    if (at_i != at_ghost) return at_i < at_ghost;
  }
  return sides_.is_taken_here(ghost);
}

}  // namespace LAMMPS_NS
