// SPDX-License-Identifier: MIT
#include "hard_case.hpp"

#include <cstdio>
#include <exception>

namespace dch::hard {

std::vector<Case> all_cases(const Effort& effort) {
  std::vector<Case> all;
  for (const auto& cases :
       {list_cases(), structure_cases(effort), refusal_cases(), necklace_cases(effort), extreme_cases()})
    all.insert(all.end(), cases.begin(), cases.end());
#ifdef DCH_HAS_ZONOTOPE
  const std::vector<Case> zonotopes = zonotope_cases();
  all.insert(all.end(), zonotopes.begin(), zonotopes.end());
#endif
  return all;
}

Finding outcome(const Case& one) {
  try {
    return one.run();
  } catch (const std::exception& error) {
    return {std::string("thrown: ") + error.what(), false};
  }
}

std::string three_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace dch::hard
