// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(colloid/dch,PairColloidDCH);
// clang-format on
#elif !defined(LMP_PAIR_COLLOID_DCH_H)
#define LMP_PAIR_COLLOID_DCH_H

#include "pair_dch.h"

namespace LAMMPS_NS {

/// colloid/dch. Where spheres overlap the kernel's forces are not finite, and then all pairs are looked at,
/// so that the run stops with the plain style's message.
class PairColloidDCH : public PairDCH {
 public:
  explicit PairColloidDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"colloid", dch::PairForm::colloid, dch::ChargeForm::none, 5, true}) {}

 private:
  void take_pair(const double*, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0], own[1], own[2], own[3]};  // A, sigma, d1, d2
    pair.cutoff = own[4];
  }
  void check_forces() override;
};

}  // namespace LAMMPS_NS

#endif
