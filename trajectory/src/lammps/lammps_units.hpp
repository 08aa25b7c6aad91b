// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace dch::trajectory {

/// One of LAMMPS's unit styles (docs.lammps.org/units.html).
struct LammpsUnits {
  std::string_view style;
  std::string_view length;
  double picoseconds;  ///< the style's unit of time [ps]; 0 for reduced units
};

/// The style of that name, or null.
const LammpsUnits* find_lammps_units(std::string_view style);

/// A style whose unit of length has that name, or null: for Angstrom it is metal, whose unit of time is 1 ps.
const LammpsUnits* find_lammps_units_by_length(std::string_view length);

}  // namespace dch::trajectory
