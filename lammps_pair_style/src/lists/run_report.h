// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dch::lammps {

/// Why something is not ours, or not done.
struct Obstacle {
  std::string reason;  ///< empty if there is none
  std::string remedy;  ///< words for the script; empty if none would help

  bool empty() const { return reason.empty(); }
};

/// One neighbor list of LAMMPS, or the cluster pairs in place of one: who fills it.
struct ListNote {
  int number = 0;      ///< from 1, as LAMMPS prints them; 0 for cluster pairs
  std::string name;    ///< who asked for it, and what kind it is
  std::string reason;  ///< why it is native; empty if it is ours
  std::string remedy;  ///< what would make it ours; empty if nothing does

  friend bool operator==(const ListNote& a, const ListNote& b) {
    return a.number == b.number && a.name == b.name && a.reason == b.reason;
  }
};

/// A style of the script, and how it computes.
struct StyleNote {
  std::string name;  ///< with its kind: "pair lj/cut/dch", "fix 1, nve"
  std::string how;   ///< and why, with the remedy if there is one
};

/// How often a style of ours has computed by its kernel, and how often it had the plain style do it.
struct Turns {
  std::int64_t by_kernel = 0, by_plain = 0;
};

/// @param why the plain style is taken at times
std::string describe(const Turns& turns, const std::string& why);

/// What is said of lists that half the skin would end. The largest of all processes counts.
enum class ExpiryVerdict {
  kept,          ///< they hold every pair within its cutoff
  cannot_tell,   ///< the engine cannot tell, or something else than positions has changed
  too_far,       ///< an atom has moved farther than the skin
  too_many,      ///< more atoms than are asked about have moved half the skin
  near_end,      ///< an atom is so near the last ghosts, or so far out, that this process cannot tell
  pair_missing,  ///< a pair within its cutoff is not in them
};
inline constexpr std::size_t kExpiryVerdicts = 6;

/// What one process counts during a run. Times in seconds of wall clock.
struct RunCounters {
  std::int64_t builds = 0;   ///< builds of our lists
  std::int64_t entries = 0;  ///< in our lists, at the last build; of a report also in cluster pairs
  std::int64_t verified_builds = 0;
  std::int64_t verified_entries = 0;
  std::array<std::int64_t, kExpiryVerdicts> verdicts{};  ///< by ExpiryVerdict, how often
  double builds_saved = 0;                               ///< that half the skin would have asked for, about
  double expiry_seconds = 0;                             ///< asking whether lists have expired
  double points_seconds = 0;                             ///< taking positions, naming points
  double structure_seconds = 0;                          ///< building and repairing the hierarchy
  double rows_seconds = 0;                               ///< candidate rows from it
  double fill_seconds = 0;                               ///< LAMMPS's lists from those
  double clusters_seconds = 0;                           ///< cluster pairs
  double verified_native_seconds = 0;                    ///< native builds of our lists, at verified builds
  double verified_dch_seconds = 0;                       ///< our builds at the same times

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
  std::string engine_reason;  ///< who has asked for it
  bool by_size = false;       ///< a structure for each class of sizes
  std::string size_reason;    ///< why, or why not
  int threads = 1;            ///< of each process
  double script_skin = 0;     ///< [length]
  std::string skin_obstacle;  ///< why no other skin is looked for
  std::string choice;         ///< what it has chosen and why, on the first process; empty if nothing
  int processes_on_grid = 0;  ///< by their own choice
  double skin = 0;            ///< that was found or is being tried; 0 if it is the script's [length]
  bool skin_settled = false;
  bool in_box =
      false;  ///< points are the atoms in the periodic box, not owned atoms and ghosts in open space
  bool leaves_ghosts_to_others = false;  ///< of ghosts those alone are points whose pairs are taken here
  bool leaves_far_ghosts = false;        ///< and those alone that may be in a pair
  std::string instructions;              ///< name of the instruction set that the search uses
  RunCounters counters;                  ///< entries summed, builds and times the largest of any process
  std::string order_obstacle;   ///< why atoms are not in the order of the structure; empty if they are
  std::string ghosts_for;       ///< why LAMMPS makes ghosts; empty if there are none
  std::string expiry_obstacle;  ///< why half the skin ends lists; empty if missing pairs do
  std::int64_t atoms = 0;
  std::int64_t structures_built = 0, repairs = 0, refreshes = 0;          ///< the largest of any process
  std::int64_t promotions = 0, demotions = 0, inserted = 0, removed = 0;  ///< summed
  int levels = 0;                                                         ///< the largest of any process
  std::int64_t memory_bytes = 0;                                          ///< structures and lists, summed
  std::vector<ListNote> lists;
  std::vector<StyleNote> styles;  ///< for `dch explain`
};

/// The report as `dch stats` prints it.
std::string format_report(const RunReport& report);

/// What was chosen for each list and style, and why, as `dch explain` prints it.
std::string format_explanation(const RunReport& report);

}  // namespace dch::lammps
