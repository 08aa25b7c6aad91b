// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(soft/dch,PairSoftDCH);
// clang-format on
#elif !defined(LMP_PAIR_SOFT_DCH_H)
#define LMP_PAIR_SOFT_DCH_H

#include "pair_dch.h"

namespace LAMMPS_NS {

/// soft/dch
class PairSoftDCH : public PairDCH {
 public:
  explicit PairSoftDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"soft", dch::PairForm::soft, dch::ChargeForm::none, 2}) {}

 private:
  void take_pair(const double*, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0]};  // a
    pair.cutoff = own[1];
  }
};

}  // namespace LAMMPS_NS

#endif
