// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include <dch/neighbor_list.hpp>

#include "atom_points.h"

namespace LAMMPS_NS {

class NeighList;

/// The pairs that `neigh_modify exclude` leaves out, as they stand when a run begins: LAMMPS's own builders
/// copy these settings then, and a fix that changes them later on does so for the next run.
class ExclusionRules : protected Pointers {
 public:
  explicit ExclusionRules(LAMMPS* lammps) : Pointers(lammps) {}

  void copy_settings();
  bool any() const { return any_; }
  bool excluded(int i, int j) const;

 private:
  struct GroupPair {
    int bit1, bit2;
  };
  struct Molecules {
    int bit;
    bool intra;
  };
  bool any_ = false;
  int stride_ = 0;
  std::vector<char> types_;  ///< stride_ x stride_, by atom types
  std::vector<GroupPair> groups_;
  std::vector<Molecules> molecules_;
};

/// A list of LAMMPS that is filled from ours, with the memory for its neighbors.
struct ServedList {
  int index = 0;  ///< in Neighbor::lists
  bool full = false;
  bool newton = false;  ///< half list, each owned-ghost pair on one side only
  bool ghost = false;   ///< has rows for ghost atoms as well
  std::vector<int> storage;
  std::int64_t pairs = 0;  ///< entries at the last build
};

/// Turns rows of candidate pairs into a NeighList: cutoffs by type, which side stores a pair, exclusions,
/// special bonds.
class ListFiller : protected Pointers {
 public:
  explicit ListFiller(LAMMPS* lammps) : Pointers(lammps), exclusions_(lammps) {}

  void copy_settings() { exclusions_.copy_settings(); }

  /// Fills `list` from `candidates`, whose particles are the points. They hold all pairs within the cutoffs
  /// and may hold more; they are half or full, with or without pairs of ghosts, as `served` is.
  void fill(const dch::NeighborList& candidates, const AtomPoints& points, ServedList& served,
            NeighList& list) const;

 private:
  int fill_row(std::size_t point, dch::Span<const std::int32_t> candidates, const AtomPoints& points,
               bool newton, int* out) const;
  bool stored_here(int i, int ghost) const;
  int special_kind(int i, int j) const;

  ExclusionRules exclusions_;
};

}  // namespace LAMMPS_NS
