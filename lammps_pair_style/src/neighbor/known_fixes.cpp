// SPDX-License-Identifier: GPL-2.0-or-later
#include "known_fixes.h"

#include <algorithm>
#include <cstring>
#include <iterator>

#include "fix_dch_order.h"

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
                                                 FixDCHOrder::kStyle};

}  // namespace

bool draws_no_random_numbers(const char* style) {
  return std::any_of(
      std::begin(kWithoutRandomNumbers), std::end(kWithoutRandomNumbers), [&](const char* name) {
        const std::size_t length = std::strlen(name);
        return std::strncmp(style, name, length) == 0 && (style[length] == '\0' || style[length] == '/');
      });
}

}  // namespace LAMMPS_NS
