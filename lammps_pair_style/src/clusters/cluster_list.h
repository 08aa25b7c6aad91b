// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <string>
#include <vector>

#include <dch/clusters/cluster_pairs.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/lists/pair_list.hpp>

#include "atom_points.h"
#include "pair_rules.h"
#include "special_pairs.h"
#include "turn_masks.h"

namespace LAMMPS_NS {

/// Pairs of clusters, or pairs one by one where neighbors are few, that a force style of ours asks for in
/// place of a neighbor list. NeighborDCH fills it when it builds lists.
struct ClusterList {
  /// Bonded pairs that the style has to weight. No cluster pair holds them.
  struct Special {
    std::vector<std::int32_t> i;  ///< owned
    std::vector<std::int32_t> j;  ///< that the force acts on: owned, or a ghost whose force LAMMPS sends home
    std::vector<std::int32_t> at;     ///< the image of j that is meant, for positions
    std::vector<std::int32_t> kind;   ///< 1 to 3: 1-2, 1-3, 1-4
    std::vector<std::int32_t> types;  ///< where both types stand in a matrix

    std::size_t size() const { return i.size(); }
    void clear() {
      for (auto* numbers : {&i, &j, &at, &kind, &types}) numbers->clear();
    }
  };

  /// Neighbors of an atom, each pair counted once, up to which pairs one by one are faster: see
  /// docs/lammps/design.md.
  static constexpr double kFewNeighbors = 9;

  std::vector<char> interacts;  ///< ntypes x ntypes: whether pairs of these types (from 0) are wanted

  bool by_levels = false;    ///< r-RESPA splits the forces, so nothing is filled
  bool one_by_one = true;    ///< which of the next two is filled
  double pairs_an_atom = 0;  ///< by which that was chosen, if by_size does not decide
  bool by_size = false;      ///< each class of sizes has a structure, of which there are no cluster pairs
  bool wants_rows = false;   ///< of the style: pairs one by one are best in whole rows, if by_size decides
  double chosen_for = 0;     ///< radius at which that was chosen [length]
  dch::PairList pair_list;   ///< of atoms: LAMMPS's indices
  dch::ClusterPairs pairs;   ///< of the same
  Special special;
  /// Whether pairs of these types, from 1, are wanted.
  bool pairs_interact(int a, int b, int types) const {
    return interacts[static_cast<std::size_t>(a - 1) * static_cast<std::size_t>(types) +
                     static_cast<std::size_t>(b - 1)] != 0;
  }

  /// Whether pairs stand row by row in the order of atoms.
  bool has_whole_rows() const { return by_size && wants_rows; }
  /// How many have numbers in them: owned ones in the box, else ghosts as well.
  std::size_t atoms() const { return one_by_one ? pair_list.particles : pairs.particles; }
  std::int64_t count() const { return one_by_one ? pair_list.pairs() : pairs.slot_pairs(); }
  std::size_t memory_bytes() const {
    return pair_list.memory_bytes() + pairs.memory_bytes() + taken_types.capacity() * sizeof(int);
  }
  /// Has pairs go by the types that atoms have by now, which fix atom/swap changes between builds. O(atoms),
  /// and next to nothing where none has changed.
  /// @param of_atoms  from 1, by LAMMPS's indices
  void take_types(const int* of_atoms, int types);

  std::vector<int> taken_types;  ///< by LAMMPS's indices; empty since the last build
  bool in_box = false;           ///< points are the atoms in the periodic box, else owned atoms and ghosts
};

/// Fills a ClusterList: types, exclusions, bonded pairs, and which process takes a pair with a ghost.
class ClusterListFiller : protected Pointers {
 public:
  ClusterListFiller(LAMMPS* lammps, SpecialPairs& special, const PairRules& rules)
      : Pointers(lammps), special_(special), rules_(rules) {}

  /// @param search brought up to date with the points
  /// @param skin that the cutoffs have now [length]
  virtual void fill(AtomPoints& points, dch::PairSearch& search, double skin, ClusterList& list);
  /// Atoms in the order of the structure, as the last list that was filled has them; maybe with padding
  /// (-1). Ghosts among them may be others than it says.
  const std::vector<std::int32_t>& order(const ClusterList& list) const {
    return list.one_by_one ? rows_.particle : list.pairs.particle;
  }

 private:
  dch::TypeCutoffs cutoffs(const ClusterList& list) const;
  void take_special_pairs(const AtomPoints& points, ClusterList& list);
  void take_special_pair(const AtomPoints& points, int i, int image, int kind, ClusterList& list);
  const dch::Exclusions* bonded_pairs(const AtomPoints& points, bool by_pairs, ClusterList& list);
  bool takes_turns(const AtomPoints& points) const;
  bool is_left_out(const AtomPoints& points, std::int32_t p, std::int32_t q) const;
  std::uint16_t mask_by_pair(const AtomPoints& points, const std::int32_t* own, const std::int32_t* other,
                             std::uint16_t mask) const;
  void leave_out(const AtomPoints& points, dch::ClusterPairs& pairs);
  void name_atoms(const AtomPoints& points, dch::ClusterPairs& pairs) const;
  void name_atoms(const AtomPoints& points, dch::PairList& pairs) const;
  void choose_kind(AtomPoints& points, dch::PairSearch& search, double skin, const dch::ListParams& params,
                   ClusterList& list);
  static std::int64_t pairs_within(const dch::ListParams& params, const dch::ClusterPairs& pairs);
  void fill_pair_list(AtomPoints& points, dch::PairSearch& search, dch::ListParams params, double skin,
                      ClusterList& list);

  SpecialPairs& special_;
  const PairRules& rules_;
  TurnMasks turns_;
  std::vector<dch::IndexPair> excluded_;
  dch::Exclusions exclusions_;
  dch::NeighborList rows_;
};

}  // namespace LAMMPS_NS
