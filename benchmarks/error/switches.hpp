// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "melt.hpp"

namespace dch::bench {

/// What a choice that the library leaves to its caller costs, on configurations 10 steps apart.
struct SwitchCost {
  std::string what;        ///< "exact list, c = 2"
  std::vector<double> ns;  ///< by repetition, one update and list [ns / atom]
  double first_ns = 0;     ///< structure and list from nothing, least of the repetitions [ns / atom]
  double bytes = 0;        ///< of the structure [1 / atom]
  double edges = 0;        ///< stored [1 / atom]
  int levels = 0;
  double listed = 0;  ///< pairs in the list [1 / atom]
  double margin = 0;  ///< NeighborList::margin of the last list [length]
};

/// The thesis's thresholds with several c, the additive ones with several R_0, and supersets, whose pairs
/// were tested in 16-bit integers alone, beside exact lists, where the few that integers leave open are
/// decided in double.
/// @throws Error if a list lacks a pair of the cell list, or an exact one holds another
std::vector<SwitchCost> costs_of_switches(const Melt& start, double skin, int configurations,
                                          int repetitions);

}  // namespace dch::bench
