// SPDX-License-Identifier: GPL-2.0-or-later
#include "angle_cosine_dch.h"

namespace LAMMPS_NS {

AngleCosineDCH::AngleCosineDCH(LAMMPS* lammps) : AngleDCH(lammps, "cosine", 1) {}

void AngleCosineDCH::make_kernel(const std::vector<double>& values) {
  std::vector<dch::CosineAngle> types;
  for (const double k : values) types.push_back({k});
  kernel_.emplace(types);
}

}  // namespace LAMMPS_NS
