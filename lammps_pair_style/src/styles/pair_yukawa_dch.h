// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(yukawa/dch,PairYukawaDCH);
// clang-format on
#elif !defined(LMP_PAIR_YUKAWA_DCH_H)
#define LMP_PAIR_YUKAWA_DCH_H

#include "pair_dch.h"

namespace LAMMPS_NS {

/// yukawa/dch
class PairYukawaDCH : public PairDCH {
 public:
  explicit PairYukawaDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"yukawa", dch::PairForm::yukawa, dch::ChargeForm::none, 2}) {}

 private:
  void take_all(const double* all, dch::PairPotentialParams& params) const override {
    params.of_all = all[0];  // kappa
  }
  void take_pair(const double*, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0]};  // a
    pair.cutoff = own[1];
  }
};

}  // namespace LAMMPS_NS

#endif
