// SPDX-License-Identifier: GPL-2.0-or-later
#include "known_fixes.h"

#include <algorithm>
#include <cstring>
#include <iterator>

#include "fix_dch_order.h"
#include "fix_dch_work.h"

namespace LAMMPS_NS {
namespace {

// Each with all whose names go on with a slash. Names in capitals are LAMMPS's own and ours. Random numbers
// of langevin/philox go by atom ID.
constexpr const char* kWithoutRandomNumbers[] = {"nve",
                                                 "nvt",
                                                 "npt",
                                                 "nph",
                                                 "addforce",
                                                 "adapt",
                                                 "ave",
                                                 "aveforce",
                                                 "balance",
                                                 "box/relax",
                                                 "cmap",
                                                 "deform",
                                                 "drag",
                                                 "dt/reset",
                                                 "efield",
                                                 "enforce2d",
                                                 "freeze",
                                                 "gravity",
                                                 "halt",
                                                 "indent",
                                                 "langevin/philox",
                                                 "lineforce",
                                                 "momentum",
                                                 "move",
                                                 "planeforce",
                                                 "press/berendsen",
                                                 "print",
                                                 "property/atom",
                                                 "qeq",
                                                 "rattle",
                                                 "recenter",
                                                 "restrain",
                                                 "setforce",
                                                 "shake",
                                                 "spring",
                                                 "store",
                                                 "temp/berendsen",
                                                 "temp/rescale",
                                                 "tune/kspace",
                                                 "vector",
                                                 "viscous",
                                                 "wall",
                                                 "STORE",
                                                 kHistoryFix,
                                                 "DUMMY",
                                                 "GROUP",
                                                 FixDCHOrder::kStyle,
                                                 FixDCHWork::kStyle};

// By their whole names: a style with a slash may do more.
constexpr const char* kFixesWithoutGhosts[] = {"nve",
                                               "nve/dch",
                                               "nve/limit",
                                               "nve/noforce",
                                               "nvt",
                                               "langevin",
                                               "langevin/dch",
                                               "langevin/philox",
                                               "temp/berendsen",
                                               "temp/csvr",
                                               "temp/rescale",
                                               "momentum",
                                               "recenter",
                                               "addforce",
                                               "aveforce",
                                               "lineforce",
                                               "planeforce",
                                               "setforce",
                                               "spring/self",
                                               "viscous",
                                               "enforce2d",
                                               "wall/harmonic",
                                               "wall/lj126",
                                               "wall/lj93",
                                               "wall/reflect",
                                               "ave/time",
                                               "dt/reset",
                                               "halt",
                                               "print",
                                               FixDCHOrder::kStyle,
                                               FixDCHWork::kStyle};
constexpr const char* kComputesWithoutGhosts[] = {"temp", "temp/com", "temp/partial", "pressure",
                                                  "pe",   "ke",       "com",          "gyration",
                                                  "msd",  "vacf",     "reduce",       "dch/work"};

template <class Names>
bool has_name(const Names& names, const char* style) {
  return std::any_of(std::begin(names), std::end(names),
                     [&](const char* name) { return std::strcmp(style, name) == 0; });
}

}  // namespace

bool is_fix_without_ghosts(const char* style) { return has_name(kFixesWithoutGhosts, style); }
bool is_compute_without_ghosts(const char* style) { return has_name(kComputesWithoutGhosts, style); }

bool draws_no_random_numbers(const char* style) {
  return std::any_of(
      std::begin(kWithoutRandomNumbers), std::end(kWithoutRandomNumbers), [&](const char* name) {
        const std::size_t length = std::strlen(name);
        return std::strncmp(style, name, length) == 0 && (style[length] == '\0' || style[length] == '/');
      });
}

}  // namespace LAMMPS_NS
