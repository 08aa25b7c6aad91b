// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

namespace LAMMPS_NS {

class Atom;
class NeighList;
class Neighbor;
struct ServedList;

/// r-RESPA computes the forces of near pairs more often than those of others, by rows of their own that
/// LAMMPS keeps in the list of all pairs.
enum class PairLevel { all, middle, inner };

/// Squared distances between which the pairs of a level are when the list is built [length^2].
struct LevelBounds {
  double above;  ///< less than 0 if there is none
  double below;
  bool hold(double r2) const { return (above < r2) & (r2 < below); }
};

/// Of the inner or the middle level; those of all pairs go by types.
LevelBounds bounds_of(PairLevel level, const Neighbor& neighbor);

/// The rows of a level in a list; they have the same owners as those of all pairs.
struct LevelRows {
  int* ilist;
  int* numneigh;
  int** firstneigh;
};

LevelRows rows_of(const NeighList& list, PairLevel level);

/// Those that the list has rows for, all pairs first.
std::vector<PairLevel> levels_of(const NeighList& list);

/// "inner level", "middle level"; empty for all pairs.
const char* name_of(PairLevel level);

/// Fills the rows of the inner and of the middle level, if the list has such, from its rows of all pairs:
/// entries, special bits included, are the same. Pairs are measured as LAMMPS's builders do, so at the same
/// positions these have the same ones. The rows lead into `served`.
void fill_levels(const Atom& atom, const Neighbor& neighbor, ServedList& served, NeighList& list);

}  // namespace LAMMPS_NS
