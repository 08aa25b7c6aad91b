// SPDX-License-Identifier: GPL-2.0-or-later
#include "cluster_verifier.h"

#include <atom.h>
#include <cmath>
#include <domain.h>
#include <force.h>
#include <neighbor.h>
#include <utility>

namespace LAMMPS_NS {

using dch::lammps::AtomPair;
using dch::lammps::ListEntry;

dch::Vec3 ClusterVerifier::between(int i, int j) const {
  const double *xi = atom->x[i], *xj = atom->x[j];
  return {xj[0] - xi[0], xj[1] - xi[1], xj[2] - xi[2]};
}

AtomPair ClusterVerifier::pair_of(int i, int j, dch::Vec3 from_i_to_j, int special, double rounding) const {
  AtomPair pair = dch::lammps::make_atom_pair(atom->tag[i], atom->tag[j], from_i_to_j, special, false);
  const double cutoff = std::sqrt(neighbor->cutneighsq[atom->type[i]][atom->type[j]]);
  pair.at_cutoff = std::abs(pair.distance() - cutoff) <= rounding;
  return pair;
}

void ClusterVerifier::take(const AtomPair& pair, int i, int j, dch::Vec3 from_i_to_j,
                           std::vector<AtomPair>& out) const {
  const bool is_within = norm2(from_i_to_j) <= neighbor->cutneighsq[atom->type[i]][atom->type[j]];
  if (is_within || pair.at_cutoff) out.push_back(pair);
}

/// Where hybrid asks for one cutoff for all types, the list goes beyond those of some.
///
/// With newton off LAMMPS has a pair through a ghost in both rows; with the atoms in the box as points ours
/// has it once.
void ClusterVerifier::take_native(const std::vector<ListEntry>& native, bool in_box, double rounding,
                                  std::vector<AtomPair>& out) const {
  const bool are_twice = in_box && !force->newton_pair;
  for (const ListEntry& e : native) {
    if (are_twice && e.j >= atom->nlocal && !rules_.stored_here(e.i, e.j)) continue;
    const dch::Vec3 from_i_to_j = between(e.i, e.j);
    AtomPair pair = pair_of(e.i, e.j, from_i_to_j, e.special, rounding);
    pair.native = true;
    take(pair, e.i, e.j, from_i_to_j, out);
  }
}

void ClusterVerifier::take_ours(const ClusterList& ours, double rounding, std::vector<AtomPair>& out) const {
  const auto take_pair = [&](std::int32_t i, std::int32_t j, dch::Vec3 from_i_to_j) {
    take(pair_of(i, j, from_i_to_j, 0, rounding), i, j, from_i_to_j, out);
  };
  if (ours.one_by_one) {
    const std::size_t points = ours.atoms();
    const auto* const x = points > 0 ? reinterpret_cast<const dch::Vec3*>(atom->x[0]) : nullptr;
    ours.pair_list.for_each({x, points}, ours.in_box ? box_of(*domain) : dch::Box::none(), take_pair);
  } else {
    ours.pairs.for_each(take_pair);
  }
  const ClusterList::Special& special = ours.special;
  for (std::size_t k = 0; k < special.size(); ++k) {
    const int i = special.i[k], image = special.at[k];
    const dch::Vec3 from_i_to_j = between(i, image);
    take(pair_of(i, image, from_i_to_j, special.kind[k], rounding), i, image, from_i_to_j, out);
  }
}

ClusterVerifier::Result ClusterVerifier::compare(const std::vector<ListEntry>& native,
                                                 const ClusterList& ours, double rounding) const {
  std::vector<AtomPair> pairs;
  take_native(native, ours.in_box, rounding, pairs);
  Result result;
  result.compared = static_cast<std::int64_t>(pairs.size());
  take_ours(ours, rounding, pairs);
  result.difference =
      verifier_.compare_pairs(std::move(pairs), force->newton_pair != 0, verifier_.image_tolerance());
  return result;
}

}  // namespace LAMMPS_NS
