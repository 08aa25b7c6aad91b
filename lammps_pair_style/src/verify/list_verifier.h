// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <string>
#include <vector>

#include "level_rows.h"
#include "list_compare.h"
#include "list_filler.h"

namespace LAMMPS_NS {

/// Compares two builds of one list as sets of pairs with their special bits, over all processes.
class ListVerifier : protected Pointers {
 public:
  explicit ListVerifier(LAMMPS* lammps) : Pointers(lammps) {}

  /// The entries of a level of the list as it stands. In a half list a pair of owned atoms stands in the row
  /// of the smaller index.
  static std::vector<dch::lammps::ListEntry> entries(const NeighList& list, const ServedList& served,
                                                     PairLevel level = PairLevel::all);

  /// Every process has to call it. Returns an empty string if the lists are equal, else a message that names
  /// the number of differing pairs and one of them; the same message on every process.
  ///
  /// With newton on a list holds a pair of an owned atom and a ghost on one side only, and the two builders
  /// choose the side by different rules: such pairs are sent to a process chosen by their atoms and compared
  /// there.
  ///
  /// Pairs at their very cutoff or a bound of the level, to within `rounding`, may be in either list: in
  /// crystals there are many, and which of them LAMMPS lists depends on the image that it looks at, and so on
  /// the number of processes [length]. Of grains farther apart than its largest cutoff, frozen or grown ones,
  /// LAMMPS lists those that its bins show.
  std::string compare(std::vector<dch::lammps::ListEntry> native, std::vector<dch::lammps::ListEntry> ours,
                      const ServedList& served, PairLevel level, double rounding) const;

  /// The same message for pairs, of which each native one needs one of ours and the reverse.
  /// @param over_processes whether the two may be with different processes
  /// @param tolerance of displacements, as unmatched() has it [length]
  std::string compare_pairs(std::vector<dch::lammps::AtomPair> pairs, bool over_processes,
                            double tolerance) const;

  /// Far more than rounding of displacements, far less than between two images of a pair [length].
  double image_tolerance() const;

 private:
  bool may_differ(const dch::lammps::ListEntry& entry, const ServedList& served, PairLevel level,
                  double rounding) const;
  void append_pairs(const std::vector<dch::lammps::ListEntry>& entries, bool native,
                    std::vector<dch::lammps::AtomPair>& out) const;
  std::vector<dch::lammps::AtomPair> exchange(const std::vector<dch::lammps::AtomPair>& pairs) const;
  std::string first_difference(const std::vector<dch::lammps::AtomPair>& differences) const;
};

}  // namespace LAMMPS_NS
