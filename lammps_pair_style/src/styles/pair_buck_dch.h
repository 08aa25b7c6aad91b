// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(buck/dch,PairBuckDCH);
PairStyle(buck/coul/long/dch,PairBuckCoulLongDCH);
// clang-format on
#elif !defined(LMP_PAIR_BUCK_DCH_H)
#define LMP_PAIR_BUCK_DCH_H

#include "pair_dch.h"

namespace LAMMPS_NS {

/// buck/dch
class PairBuckDCH : public PairDCH {
 public:
  explicit PairBuckDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"buck", dch::PairForm::buckingham, dch::ChargeForm::none, 4}) {}

 private:
  void take_pair(const double*, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0], own[1], own[2]};  // a, rho, c
    pair.cutoff = own[3];
  }
};

/// buck/coul/long/dch
class PairBuckCoulLongDCH : public PairDCH {
 public:
  explicit PairBuckCoulLongDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"buck/coul/long", dch::PairForm::buckingham, dch::ChargeForm::ewald, 4}) {}

 private:
  void take_pair(const double* all, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0], own[1], own[2]};
    pair.cutoff = own[3];
    pair.charge_cutoff = all[1];  // behind the global cutoff of the form
  }
};

}  // namespace LAMMPS_NS

#endif
