// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond_fene_dch.h"

#include <atom.h>

namespace LAMMPS_NS {

BondFENEDCH::BondFENEDCH(LAMMPS* lammps) : BondDCH(lammps, "fene", 4) {}

void BondFENEDCH::make_kernel(const std::vector<double>& values) {
  const std::size_t n = values.size() / 4;
  std::vector<dch::FeneBond> types;
  for (std::size_t k = 0; k < n; ++k)
    types.push_back({values[k], values[n + k], values[2 * n + k], values[3 * n + k]});
  kernel_ = std::make_unique<dch::FeneForces>(types);
}

void BondFENEDCH::add_forces(dch::Span<const dch::Vec3> positions, dch::Span<dch::Vec3> forces,
                             bool wants_virial, std::array<double, 6>& sums) {
  kernel_->add_forces(bonds(), 1, positions, forces, too_long_, wants_virial ? &sums : nullptr);
  for (const std::int32_t k : too_long_) add_long_bond(bonds()[static_cast<std::size_t>(k)], sums);
}

/// The plain style warns, or stops if it breaks.
void BondFENEDCH::add_long_bond(const dch::BondOfType& bond, std::array<double, 6>& sums) {
  const double *xi = atom->x[bond.i], *xj = atom->x[bond.j];
  const dch::Vec3 d{xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]};
  double over_r = 0;
  plain_->single(bond.type, norm2(d), bond.i, bond.j, over_r);
  const dch::Vec3 pull = over_r * d;
  double *of_i = atom->f[bond.i], *of_j = atom->f[bond.j];
  for (int axis = 0; axis < 3; ++axis) {
    of_i[axis] += pull[axis];
    of_j[axis] -= pull[axis];
    sums[static_cast<std::size_t>(axis)] += d[axis] * pull[axis];
  }
  sums[3] += d.x * pull.y;
  sums[4] += d.x * pull.z;
  sums[5] += d.y * pull.z;
}

}  // namespace LAMMPS_NS
