// SPDX-License-Identifier: GPL-2.0-or-later
#include "list_filler.h"

#include <algorithm>
#include <atom.h>
#include <domain.h>
#include <neigh_list.h>
#include <neighbor.h>

namespace LAMMPS_NS {

void ExclusionRules::copy_settings() {
  any_ = neighbor->exclude != 0;
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

bool ExclusionRules::excluded(int i, int j) const {
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

// The parity of the IDs decides, which every process sees alike; an atom and its own image are told apart by
// their coordinates, of which equal ones are equal bit by bit, since ghosts are made by adding whole box
// vectors.
bool ListFiller::stored_here(int i, int ghost) const {
  const tagint tag_i = atom->tag[i], tag_j = atom->tag[ghost];
  const bool even_sum = ((tag_i ^ tag_j) & 1) == 0;
  if (tag_i != tag_j) return (tag_i < tag_j) == even_sum;
  const double *xi = atom->x[i], *xj = atom->x[ghost];
  if (xj[2] != xi[2]) return xj[2] > xi[2];
  if (xj[1] != xi[1]) return xj[1] > xi[1];
  return xj[0] >= xi[0];
}

// 0: an ordinary pair, 1 to 3: a 1-2, 1-3, 1-4 pair that the pair style has to weight, -1: one that it never
// sees.
int ListFiller::special_kind(int i, int j) const {
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

int ListFiller::fill_row(std::size_t point, dch::Span<const std::int32_t> candidates,
                         const AtomPoints& points, bool newton, int* out) const {
  const int owned = atom->nlocal;
  const int i = points.atoms()[point];
  const bool ghost_row = i >= owned;
  const bool molecular = atom->molecular != Atom::ATOMIC && !ghost_row;
  const double* cutsq = (ghost_row ? neighbor->cutneighghostsq : neighbor->cutneighsq)[atom->type[i]];
  const dch::Vec3 xi = points.positions()[point];
  int n = 0;
  for (const std::int32_t candidate : candidates) {
    const auto q = static_cast<std::size_t>(candidate);
    const int j = points.atoms()[q];
    const dch::Vec3 del = xi - points.positions()[q];
    if (norm2(del) > cutsq[atom->type[j]]) continue;
    if (newton && j >= owned && !stored_here(i, j)) continue;
    if (exclusions_.any() && exclusions_.excluded(i, j)) continue;
    int entry = j;
    if (molecular) {
      const int kind = special_kind(i, j);
      // A bonded atom's far image is no bonded atom: LAMMPS stores it as an ordinary neighbor.
      if (kind != 0 && !domain->minimum_image_check(del.x, del.y, del.z)) {
        if (kind < 0) continue;
        entry ^= kind << SBBITS;
      }
    }
    out[n++] = entry;
  }
  return n;
}

void ListFiller::fill(const dch::NeighborList& candidates, const AtomPoints& points, ServedList& served,
                      NeighList& list) const {
  const auto owned = static_cast<std::size_t>(points.owned());
  const auto bound = static_cast<std::size_t>(candidates.first.back());
  if (served.storage.size() < bound) served.storage.resize(bound);
  int* out = served.storage.data();
  std::size_t rows = owned;
  for (std::size_t r = 0; r < candidates.size(); ++r) {
    const std::size_t point =
        candidates.particle.empty() ? r : static_cast<std::size_t>(candidates.particle[r]);
    if (point >= owned && !served.ghost) continue;
    const int i = points.atoms()[point];
    const int n = fill_row(point, candidates.row(r), points, served.newton, out);
    list.ilist[point] = i;  // the order of the atoms in memory, whatever the order of the rows
    rows = std::max(rows, point + 1);
    list.firstneigh[i] = out;
    list.numneigh[i] = n;
    out += n;
  }
  list.inum = static_cast<int>(owned);
  list.gnum = static_cast<int>(rows - owned);
  served.pairs = out - served.storage.data();
}

}  // namespace LAMMPS_NS
