// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <lmptype.h>
#include <pointers.h>
#include <vector>

#include <dch/base/vec3.hpp>

namespace LAMMPS_NS {

/// Knows at which steps LAMMPS would have built lists by its own rule, while they are built at fewer.
///
/// LAMMPS sorts atoms at the first build after a sort is due, and fixes draw random numbers in the order of
/// atoms. One process that sorts at the steps at which it would have sorted keeps that order, and the numbers
/// go to the same atoms: nothing else at a build moves atoms in memory but AtomOrder.
class StockBuilds : protected Pointers {
 public:
  explicit StockBuilds(LAMMPS* lammps) : Pointers(lammps) {}

  /// A run begins, with a build.
  void begin_run(bool wanted) {
    is_wanted_ = wanted;
    differs_ = defers_ = false;
  }

  /// LAMMPS looks at atoms. Whether it would build lists now.
  /// @param moved_far whether an atom has moved half the skin since our build; that of LAMMPS if none differs
  /// @param trigger2 square of half the skin [length^2]
  bool is_due(bool moved_far, double trigger2) const;
  /// Whether it would sort atoms then.
  bool would_sort() const;
  /// It would build now, and we do not.
  void note_missed();
  /// We build now, where it would not: atoms must not be sorted.
  void defer_sort();
  /// Atoms have been moved in memory, in the middle of a build.
  /// @param places by old index the new one; empty if none has been moved
  void follow(const std::vector<int>& places);
  /// Lists are being built, now that atoms have been wrapped, sent and sorted.
  void note_build();

 private:
  int owned() const;
  dch::Vec3 place(int i) const;

  bool is_wanted_ = false;
  bool differs_ = false;         ///< LAMMPS's last build would not have been our last
  bool defers_ = false;          ///< since a build that has begun
  std::vector<dch::Vec3> hold_;  ///< where atoms were at that build; moves since then while `defers_`
  bigint next_sort_ = 0;         ///< put off
};

}  // namespace LAMMPS_NS
