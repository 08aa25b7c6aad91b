// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>
#include <cstdlib>

namespace LAMMPS_NS {

/// A word of the input script as a finite number, else NaN.
inline double finite_number(const char* word) {
  char* end = nullptr;
  const double value = std::strtod(word, &end);
  return end != word && *end == '\0' && std::isfinite(value) ? value : std::nan("");
}

}  // namespace LAMMPS_NS
