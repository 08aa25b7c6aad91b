// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <dch/base/vec3.hpp>

namespace dch::lammps {

/// One entry of a neighbor list: atom j stands in the row of atom i, with special bits 0 to 3 (1-2, 1-3, 1-4
/// neighbors).
struct ListEntry {
  int i = 0, j = 0, special = 0;

  friend bool operator<(const ListEntry& a, const ListEntry& b) {
    if (a.i != b.i) return a.i < b.i;
    if (a.j != b.j) return a.j < b.j;
    return a.special < b.special;
  }
  friend bool operator==(const ListEntry& a, const ListEntry& b) {
    return a.i == b.i && a.j == b.j && a.special == b.special;
  }
};

/// What two lists do not share; an entry that one list holds k times more often is left over k times.
struct ListDifference {
  std::vector<ListEntry> native_only;
  std::vector<ListEntry> dch_only;
};

/// Compares the lists as sets; their order does not matter. O(n lg n).
ListDifference compare_entries(std::vector<ListEntry> native, std::vector<ListEntry> dch);

/// A pair of atoms with the displacement between them, the same wherever it was seen: by the process that
/// owns one atom with the other as its ghost, or the reverse, or by one process through either of two
/// periodic images.
struct AtomPair {
  std::int64_t low = 0, high = 0;  ///< atom IDs, low <= high
  Vec3 displacement;               ///< from low to high [length]
  int special = 0;
  bool native = false;     ///< seen in the native list, not in ours
  bool at_cutoff = false;  ///< to within rounding: it may be in either alone

  double distance() const;
};

/// The pair of atoms with IDs tag_i and tag_j at x_j - x_i = d. For an atom and an image of itself d and -d
/// are one pair.
AtomPair make_atom_pair(std::int64_t tag_i, std::int64_t tag_j, Vec3 d, int special, bool native);

/// Cancels each native pair with one of ours: same atoms, same special bits, displacements equal within
/// `tolerance`. Returns the pairs left without a partner, sorted by atoms. Rounding makes x_j + L - x_i and
/// x_j - (x_i - L) differ in the last digits, but images are a whole box apart, so a small fraction of the
/// box does as tolerance. O(n lg n).
std::vector<AtomPair> unmatched(std::vector<AtomPair> pairs, double tolerance);

/// Without those at their very cutoff.
void drop_at_cutoff(std::vector<AtomPair>& pairs);

/// "pair of atoms 17 and 1204 at distance 2.51, special bits 0: in the native list only".
std::string describe(const AtomPair& pair);

}  // namespace dch::lammps
