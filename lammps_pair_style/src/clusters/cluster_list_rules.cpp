// SPDX-License-Identifier: GPL-2.0-or-later
// What is left out of the pairs that the search finds, and their names: LAMMPS's indices of atoms.
#include <atom.h>
#include <force.h>

#include "cluster_list.h"

namespace LAMMPS_NS {

/// Whether there are ghosts among the points whose pairs other processes take.
bool ClusterListFiller::takes_turns(const AtomPoints& points) const {
  return points.has_ghosts_of_others() && force->newton_pair;
}

/// Of points: pairs that `neigh_modify exclude` leaves out, and those with a ghost that another process
/// takes.
bool ClusterListFiller::is_left_out(const AtomPoints& points, std::int32_t p, std::int32_t q) const {
  const int i = points.atom_of(p), j = points.atom_of(q);
  if (rules_.excludes_any() && rules_.excluded(i, j)) return true;
  if (!takes_turns(points) || (p < points.owned() && q < points.owned())) return false;
  return p < points.owned() ? !rules_.stored_here(i, j) : !rules_.stored_here(j, i);
}

/// The pairs of two clusters that stay, asked about one by one.
std::uint16_t ClusterListFiller::mask_by_pair(const AtomPoints& points, const std::int32_t* own,
                                              const std::int32_t* other, std::uint16_t mask) const {
  constexpr int kSlots = dch::ClusterPairs::kSlots;
  for (int bit = 0; bit < kSlots * kSlots; ++bit) {
    if ((mask >> bit & 1) != 0 && is_left_out(points, own[bit / kSlots], other[bit % kSlots]))
      mask = static_cast<std::uint16_t>(mask & ~(1 << bit));
  }
  return mask;
}

void ClusterListFiller::leave_out(const AtomPoints& points, dch::ClusterPairs& pairs) {
  constexpr int kSlots = dch::ClusterPairs::kSlots;
  const bool takes_turns = this->takes_turns(points);
  if (!rules_.excludes_any() && !takes_turns) return;
  const bool by_side = !rules_.excludes_any() && rules_.goes_by_side();
  if (by_side)
    turns_.assign(pairs.particle,
                  [&](std::int32_t point) { return rules_.sides().is_taken_here(points.atom_of(point)); });
  const auto mask_of = [&](std::int32_t own, const dch::ClusterPairs::Entry& entry) {
    if (by_side) return static_cast<std::uint16_t>(entry.mask & turns_.mask(own, entry.cluster));
    return mask_by_pair(points, &pairs.particle[kSlots * static_cast<std::size_t>(own)],
                        &pairs.particle[kSlots * static_cast<std::size_t>(entry.cluster)], entry.mask);
  };
  std::int64_t from = 0, to = 0;
  std::size_t rows = 0;
  for (std::size_t r = 0; r + 1 < pairs.rows.size(); ++r) {
    const std::int64_t row_begins = to;
    for (; from < pairs.rows[r + 1].first; ++from) {
      dch::ClusterPairs::Entry entry = pairs.entries[static_cast<std::size_t>(from)];
      entry.mask = mask_of(pairs.rows[r].cluster, entry);
      if (entry.mask != 0) pairs.entries[static_cast<std::size_t>(to++)] = entry;
    }
    if (to > row_begins) pairs.rows[rows++] = {row_begins, pairs.rows[r].cluster, pairs.rows[r].first_shift};
  }
  pairs.rows.resize(rows);
  pairs.rows.push_back({to, 0, 0});
  pairs.entries.resize(static_cast<std::size_t>(to));
}

namespace {

void name_atoms(const AtomPoints& points, std::vector<std::int32_t>& named) {
  for (std::int32_t& k : named) k = k < 0 ? k : points.atom_of(k);
}

}  // namespace

/// Of points that are not atoms with the same indices: makes them those, so that forces know no points.
void ClusterListFiller::name_atoms(const AtomPoints& points, dch::ClusterPairs& pairs) const {
  if (points.in_box() || points.are_atoms()) return;
  LAMMPS_NS::name_atoms(points, pairs.particle);
  pairs.particles = static_cast<std::size_t>(atom->nlocal + atom->nghost);
}

void ClusterListFiller::name_atoms(const AtomPoints& points, dch::PairList& pairs) const {
  if (points.in_box() || points.are_atoms()) return;
  LAMMPS_NS::name_atoms(points, pairs.i);
  LAMMPS_NS::name_atoms(points, pairs.j);
  pairs.particles = static_cast<std::size_t>(atom->nlocal + atom->nghost);
  if (pairs.type.empty()) return;
  pairs.type.resize(pairs.particles);
  for (std::size_t i = 0; i < pairs.particles; ++i) pairs.type[i] = atom->type[i] - 1;
}

}  // namespace LAMMPS_NS
