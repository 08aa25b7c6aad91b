// SPDX-License-Identifier: GPL-2.0-or-later
#include "angle_harmonic_dch.h"

namespace LAMMPS_NS {

AngleHarmonicDCH::AngleHarmonicDCH(LAMMPS* lammps) : AngleDCH(lammps, "harmonic", 2) {}

void AngleHarmonicDCH::make_kernel(const std::vector<double>& values) {
  const std::size_t n = values.size() / 2;
  std::vector<dch::HarmonicAngle> types;
  for (std::size_t k = 0; k < n; ++k) types.push_back({values[k], values[n + k]});
  kernel_.emplace(types);
}

}  // namespace LAMMPS_NS
