// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(morse/dch,PairMorseDCH);
// clang-format on
#elif !defined(LMP_PAIR_MORSE_DCH_H)
#define LMP_PAIR_MORSE_DCH_H

#include "pair_dch.h"

namespace LAMMPS_NS {

/// morse/dch
class PairMorseDCH : public PairDCH {
 public:
  explicit PairMorseDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"morse", dch::PairForm::morse, dch::ChargeForm::none, 4}) {}

 private:
  void take_pair(const double*, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0], own[1], own[2]};  // d0, alpha, r0
    pair.cutoff = own[3];
  }
};

}  // namespace LAMMPS_NS

#endif
