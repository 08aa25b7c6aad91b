// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "input/chain_topology.hpp"

namespace dch::cli {

/// The radii of beads as the option --radius gives them: one for all, or one for each type.
class BeadRadii {
 public:
  /// @param text a length, "0.5", or one for each type of atom, "1=0.5,2=0.7"
  /// @throws UsageError for anything else, a radius that is negative or too large, and a type given twice.
  explicit BeadRadii(const std::string& text);

  /// By particle of the chains.
  /// @param file the trajectory's name, for messages
  /// @throws UsageError if radii go by type and the trajectory has no types, or a bead has another type.
  std::vector<double> of(const BeadChains& beads, const std::string& file) const;

 private:
  double all_ = 0;
  std::map<std::int32_t, double> by_type_;  ///< empty: all have the same
};

}  // namespace dch::cli
