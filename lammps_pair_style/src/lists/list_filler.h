// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "atom_points.h"
#include "ghost_images.h"
#include "pair_rules.h"
#include "special_pairs.h"

namespace LAMMPS_NS {

class NeighList;

/// A list of LAMMPS that is filled from ours, which holds its neighbors.
struct ServedList {
  int index = 0;  ///< in Neighbor::lists
  bool full = false;
  bool newton = false;     ///< half list, each owned-ghost pair on one side only
  bool ghost = false;      ///< has rows for ghost atoms as well
  bool by_radius = false;  ///< granular: the cutoff of a pair is the sum of the radii
  bool history = false;    ///< of those that touch, entries are marked for FixNeighHistory
  dch::NeighborList rows;  ///< of points; when LAMMPS's list is filled its pointers lead here or into by_atom
  std::vector<std::int32_t> by_atom;        ///< short rows, in the order of the atoms
  std::vector<std::int32_t> inner, middle;  ///< rows of r-RESPA's levels, if LAMMPS's list has these
  std::int64_t pairs = 0;                   ///< entries at the last build, of levels too
  /// Whether rows took a line of the cache or less on average. Then it costs a pair style more to look for
  /// the next row than to read it, so rows are put in the order in which it goes through atoms.
  bool has_short_rows = false;

  std::size_t memory_bytes() const {
    return (rows.j.capacity() + rows.particle.capacity() + by_atom.capacity() + inner.capacity() +
            middle.capacity()) *
               sizeof(std::int32_t) +
           rows.first.capacity() * sizeof(std::int64_t);
  }
};

/// Turns rows of points into a NeighList: which image of a neighbor, which side stores a pair, exclusions,
/// special bonds, levels of r-RESPA.
class ListFiller : protected Pointers {
 public:
  ListFiller(LAMMPS* lammps, SpecialPairs& special, const PairRules& rules)
      : Pointers(lammps), special_(special), rules_(rules) {}

  /// Fills `list` from served.rows, which it edits in place unless they are short. They hold the pairs of
  /// points within the cutoffs, those of lists with ghost rows maybe more. In the box each pair stands once,
  /// or twice if the list is full or newton is off; in open space they are as ListParams::first_ghost makes
  /// them.
  /// @param images of points in the box; not looked at in open space
  void fill(const AtomPoints& points, const GhostImages& images, ServedList& served, NeighList& list);

 private:
  struct Scene {
    const AtomPoints& points;
    const GhostImages& images;
    const ServedList& served;
  };
  bool stays_as_it_is(const Scene& scene, int i, dch::Span<const std::int32_t> row) const;
  bool has_plain_rows(const Scene& scene) const;
  int edit_plain_row(const Scene& scene, const SpecialPairs::Marks& marks, int i, const std::int32_t* row,
                     int count, std::int32_t* to) const;
  int edit_row(const Scene& scene, int i, const std::int32_t* row, int count, std::int32_t* to) const;
  static bool has_short_rows(const Scene& scene);
  void sort_rows(ServedList& served);
  void refuse_history(int i, int count) const;
  int mark_of(const ServedList& served, int i, int j) const;
  int neighbor_of(const Scene& scene, int i, std::int32_t point, bool inside) const;

  SpecialPairs& special_;
  const PairRules& rules_;
  std::vector<std::size_t> row_of_;  ///< by point, where rows are short
};

}  // namespace LAMMPS_NS
