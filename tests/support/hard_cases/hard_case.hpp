// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

/// The table of hard cases: inputs that lead rounding or bookkeeping astray, with what is expected of them.
/// Unit tests go through it, and the program dch_hard_cases prints it.
namespace dch::hard {

/// What came out of a case.
struct Finding {
  std::string found;  ///< the same on every machine
  bool passed = false;
};

struct Case {
  std::string area;  ///< "lists", "refusals", ...
  std::string name;
  std::string expected;
  std::function<Finding()> run;
};

inline std::ostream& operator<<(std::ostream& out, const Case& hard) {
  return out << hard.area << ": " << hard.name;
}

/// How much to do.
struct Effort {
  int repairs = 100000;             ///< in a row
  std::int32_t most_beads = 65536;  ///< of necklaces whose visited pairs are counted
};

std::vector<Case> list_cases();
std::vector<Case> structure_cases(const Effort& effort);
std::vector<Case> refusal_cases();
std::vector<Case> necklace_cases(const Effort& effort);
std::vector<Case> extreme_cases();
/// Where zonotopes are built.
std::vector<Case> zonotope_cases();
/// Those that need the power diagram.
std::vector<Case> diagram_cases();

/// All but those of the power diagram.
std::vector<Case> all_cases(const Effort& effort);

/// Runs a case; an exception that it lets out is a finding that did not pass.
Finding outcome(const Case& one);

/// Three significant digits, so that rounding of the last does not show.
std::string three_digits(double value);

}  // namespace dch::hard
