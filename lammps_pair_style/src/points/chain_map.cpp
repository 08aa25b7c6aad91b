// SPDX-License-Identifier: GPL-2.0-or-later
#include "chain_map.h"

#include <algorithm>
#include <array>
#include <atom.h>
#include <comm.h>
#include <force.h>
#include <utility>

namespace LAMMPS_NS {
namespace {

/// Calls use(tag, partner's tag) for each bond that owned atoms of the group hold: with newton on for bonds
/// one of the two atoms has a bond, else both have it. Type 0 is a bond that is switched off for good.
template <class Use>
void for_bonds(const Atom& atom, bool newton_bond, int group_bit, const Use& use) {
  for (int i = 0; i < atom.nlocal; ++i) {
    if (!(atom.mask[i] & group_bit)) continue;
    for (int m = 0; m < atom.num_bond[i]; ++m) {
      const tagint other = atom.bond_atom[i][m];
      if (atom.bond_type[i][m] != 0 && (newton_bond || other >= atom.tag[i])) use(atom.tag[i], other);
    }
  }
}

}  // namespace

bool ChainMap::follow(int group_bit) {
  bytes_ = 0;
  if (known_ && are_as_before(group_bit)) return false;
  known_ = false;
  std::vector<tagint> mine;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & group_bit) mine.push_back(atom->tag[i]);
  tags_ = gather_all(std::move(mine), MPI_LMP_TAGINT, *error, world);
  std::sort(tags_.begin(), tags_.end());
  const std::vector<dch::IndexPair> bonds = gather_bonds(group_bit);
  bytes_ += static_cast<bigint>(tags_.size() * sizeof(tagint)) * (comm->nprocs - 1);
  bond_count_ = static_cast<bigint>(bonds.size());
  chains_ = dch::necklace::Necklace(dch::necklace::Chains::from_bonds(tags_.size(), bonds), 1.0);
  place_.assign(tags_.size(), -1);
  const auto beads = chains_.particle();
  for (std::size_t place = 0; place < beads.size(); ++place)
    place_[static_cast<std::size_t>(beads[place])] = static_cast<std::int32_t>(place);
  return known_ = true;
}

/// As many atoms and bonds as there were, each of which was there, are the same ones.
bool ChainMap::are_as_before(int group_bit) const {
  std::array<bigint, 3> mine{}, all{};  // atoms, bonds, and what was not there
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & group_bit)) continue;
    ++mine[0];
    mine[2] += bead_of(atom->tag[i]) < 0;
  }
  for_bonds(*atom, force->newton_bond != 0, group_bit, [&](tagint tag, tagint other) {
    const std::int32_t a = bead_of(tag), b = bead_of(other);
    if (a < 0 || b < 0) return;
    ++mine[1];
    mine[2] += place_of(a) < 0 || place_of(b) < 0 || chains_.bonds_between(place_of(a), place_of(b)) != 1;
  });
  MPI_Allreduce(mine.data(), all.data(), 3, MPI_LMP_BIGINT, MPI_SUM, world);
  return all[0] == static_cast<bigint>(tags_.size()) && all[1] == bond_count_ && all[2] == 0;
}

/// Those with both ends in the group, in ascending order.
std::vector<dch::IndexPair> ChainMap::gather_bonds(int group_bit) {
  std::vector<tagint> mine;
  for_bonds(*atom, force->newton_bond != 0, group_bit, [&](tagint tag, tagint other) {
    mine.insert(mine.end(), {tag, other});
  });
  const std::vector<tagint> ends = gather_all(std::move(mine), MPI_LMP_TAGINT, *error, world);
  bytes_ += static_cast<bigint>(ends.size() * sizeof(tagint)) * (comm->nprocs - 1);
  std::vector<dch::IndexPair> bonds;
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
    const std::int32_t i = bead_of(ends[k]), j = bead_of(ends[k + 1]);
    if (i >= 0 && j >= 0) bonds.push_back({std::min(i, j), std::max(i, j)});
  }
  std::sort(bonds.begin(), bonds.end());
  return bonds;
}

std::int32_t ChainMap::bead_of(tagint tag) const {
  if (tags_.empty() || tag < tags_.front() || tag > tags_.back()) return -1;
  // Mostly no number is left out.
  const auto guess = static_cast<std::size_t>(tag - tags_.front());
  if (guess < tags_.size() && tags_[guess] == tag) return static_cast<std::int32_t>(guess);
  const auto found = std::lower_bound(tags_.begin(), tags_.end(), tag);
  return *found == tag ? static_cast<std::int32_t>(found - tags_.begin()) : -1;
}

}  // namespace LAMMPS_NS
