// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "switches.hpp"
#include "trial.hpp"

namespace dch::bench {

/// A trial with what came of it.
struct TrialResult {
  Trial trial;
  TrialErrors errors;
  std::vector<double> ns;  ///< by repetition [ns / atom / step]
};

/// All of one run of the program.
struct ErrorReport {
  std::size_t atoms = 0;
  std::uint64_t seed = 0;
  std::uint64_t list_hash = 0;  ///< of the pairs within the cutoff that trials start with
  TrialLength length;
  std::vector<TrialResult> trials;
  double switches_skin = 0;  ///< [length]
  std::vector<SwitchCost> switches;
};

void print(const ErrorReport& report);
/// @throws Error if the file cannot be written.
void write_json(const std::string& path, const ErrorReport& report);

}  // namespace dch::bench
