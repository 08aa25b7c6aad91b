// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef BOND_CLASS
// clang-format off
BondStyle(fene/dch,BondFENEDCH);
// clang-format on
#elif !defined(LMP_BOND_FENE_DCH_H)
#define LMP_BOND_FENE_DCH_H

#include "bond_dch.h"

namespace LAMMPS_NS {

/// fene/dch: the plain style warns of bonds that are too long, and stops if they break.
class BondFENEDCH : public BondDCH {
 public:
  explicit BondFENEDCH(LAMMPS* lammps);

 private:
  void make_kernel(const std::vector<double>& values) override;
  void add_forces(dch::Span<const dch::Vec3> positions, dch::Span<dch::Vec3> forces, bool wants_virial,
                  std::array<double, 6>& sums) override;
  void add_long_bond(const dch::BondOfType& bond, std::array<double, 6>& sums);

  std::unique_ptr<dch::FeneForces> kernel_;
  std::vector<std::int32_t> too_long_;
};

}  // namespace LAMMPS_NS

#endif
