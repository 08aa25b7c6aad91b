// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef BOND_CLASS
// clang-format off
BondStyle(harmonic/dch,BondHarmonicDCH);
// clang-format on
#elif !defined(LMP_BOND_HARMONIC_DCH_H)
#define LMP_BOND_HARMONIC_DCH_H

#include <dch/forces/harmonic_bonds.hpp>

#include "bond_dch.h"

namespace LAMMPS_NS {

/// harmonic/dch: springs; no bond is too long.
class BondHarmonicDCH : public BondDCH {
 public:
  explicit BondHarmonicDCH(LAMMPS* lammps);

 private:
  void make_kernel(const std::vector<double>& values) override;
  void add_forces(dch::Span<const dch::Vec3> positions, dch::Span<dch::Vec3> forces, bool wants_virial,
                  std::array<double, 6>& sums) override;

  std::unique_ptr<dch::HarmonicForces> kernel_;
};

}  // namespace LAMMPS_NS

#endif
