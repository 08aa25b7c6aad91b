// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond_harmonic_dch.h"

namespace LAMMPS_NS {

BondHarmonicDCH::BondHarmonicDCH(LAMMPS* lammps) : BondDCH(lammps, "harmonic", 2) {}

void BondHarmonicDCH::make_kernel(const std::vector<double>& values) {
  const std::size_t n = values.size() / 2;
  std::vector<dch::HarmonicBond> types;
  for (std::size_t k = 0; k < n; ++k) types.push_back({values[k], values[n + k]});
  kernel_ = std::make_unique<dch::HarmonicForces>(types);
}

void BondHarmonicDCH::add_forces(dch::Span<const dch::Vec3> positions, dch::Span<dch::Vec3> forces,
                                 bool wants_virial, std::array<double, 6>& sums) {
  kernel_->add_forces(bonds(), 1, positions, forces, wants_virial ? &sums : nullptr);
}

}  // namespace LAMMPS_NS
