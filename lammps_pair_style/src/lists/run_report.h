// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dch::lammps {

/// One neighbor list of LAMMPS, or the cluster pairs in place of one: who fills it.
struct ListNote {
  int number = 0;      ///< from 1, as LAMMPS prints them; 0 for cluster pairs
  std::string name;    ///< who asked for it, and what kind it is
  std::string reason;  ///< why it is native; empty if it is ours

  friend bool operator==(const ListNote& a, const ListNote& b) {
    return a.number == b.number && a.name == b.name && a.reason == b.reason;
  }
};

/// What one process counts during a run. Times in seconds of wall clock.
struct RunCounters {
  std::int64_t builds = 0;   ///< builds of our lists
  std::int64_t entries = 0;  ///< in our lists, at the last build
  std::int64_t verified_builds = 0;
  std::int64_t verified_entries = 0;
  double points_seconds = 0;           ///< taking positions, naming points
  double structure_seconds = 0;        ///< building and repairing the hierarchy
  double rows_seconds = 0;             ///< candidate rows from it
  double fill_seconds = 0;             ///< LAMMPS's lists from those
  double clusters_seconds = 0;         ///< cluster pairs
  double verified_native_seconds = 0;  ///< native builds of our lists, at verified builds
  double verified_dch_seconds = 0;     ///< our builds at the same times

  double seconds() const {
    return points_seconds + structure_seconds + rows_seconds + fill_seconds + clusters_seconds;
  }
};

/// The same over all processes, with what their search structures did.
struct RunReport {
  bool enabled = false;
  int verify_every = 0;
  int processes = 1;
  double radius = 0;          ///< of the search [length]
  std::string engine;         ///< that fills lists and cluster pairs
  std::string choice;         ///< what it has chosen and why, on the first process; empty if nothing
  int processes_on_grid = 0;  ///< by their own choice
  double skin = 0;            ///< that was found or is being tried; 0 if it is the script's [length]
  bool skin_settled = false;
  bool in_box =
      false;  ///< points are the atoms in the periodic box, not owned atoms and ghosts in open space
  std::string instructions;    ///< name of the instruction set that the search uses
  RunCounters counters;        ///< entries summed, builds and times the largest of any process
  std::string order_obstacle;  ///< why atoms are not in the order of the structure; empty if they are
  std::int64_t atoms = 0;
  std::int64_t structures_built = 0, repairs = 0, refreshes = 0;          ///< the largest of any process
  std::int64_t promotions = 0, demotions = 0, inserted = 0, removed = 0;  ///< summed
  int levels = 0;                                                         ///< the largest of any process
  std::int64_t memory_bytes = 0;                                          ///< structures and lists, summed
  std::vector<ListNote> lists;
};

/// The report as `dch stats` prints it.
std::string format_report(const RunReport& report);

}  // namespace dch::lammps
