// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include <dch/neighbor_list.hpp>

#include "atom_points.h"
#include "ghost_images.h"
#include "special_pairs.h"

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

/// A list of LAMMPS that is filled from ours, which holds its neighbors.
struct ServedList {
  int index = 0;  ///< in Neighbor::lists
  bool full = false;
  bool newton = false;     ///< half list, each owned-ghost pair on one side only
  bool ghost = false;      ///< has rows for ghost atoms as well
  dch::NeighborList rows;  ///< of points; when LAMMPS's list is filled its pointers lead here
  std::int64_t pairs = 0;  ///< entries at the last build
};

/// Turns rows of points into a NeighList: which image of a neighbor, which side stores a pair, exclusions,
/// special bonds.
class ListFiller : protected Pointers {
 public:
  ListFiller(LAMMPS* lammps, const SpecialPairs& special)
      : Pointers(lammps), exclusions_(lammps), special_(special) {}

  void copy_settings() { exclusions_.copy_settings(); }

  /// Fills `list` from served.rows, which it edits in place. They hold the pairs of points within the
  /// cutoffs, those of lists with ghost rows maybe more. In the box each pair stands once, or twice if the
  /// list is full or newton is off; in open space they are as ListParams::first_ghost makes them.
  /// @param images of points in the box; not looked at in open space
  void fill(const AtomPoints& points, const GhostImages& images, ServedList& served, NeighList& list) const;

 private:
  struct Scene {
    const AtomPoints& points;
    const GhostImages& images;
    const ServedList& served;
  };
  bool stays_as_it_is(const Scene& scene, int i, dch::Span<const std::int32_t> row) const;
  int edit_row(const Scene& scene, int i, std::int32_t* row, int count) const;
  int neighbor_of(const Scene& scene, int i, std::int32_t point, bool inside) const;
  bool stored_here(int i, int ghost) const;

  ExclusionRules exclusions_;
  const SpecialPairs& special_;
};

}  // namespace LAMMPS_NS
