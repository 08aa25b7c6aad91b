// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(lj/charmm/coul/long/dch,PairLJCharmmCoulLongDCH);
PairStyle(lj/charmm/coul/charmm/dch,PairLJCharmmCoulCharmmDCH);
PairStyle(lj/charmmfsw/coul/long/dch,PairLJCharmmfswCoulLongDCH);
// clang-format on
#elif !defined(LMP_PAIR_CHARMM_DCH_H)
#define LMP_PAIR_CHARMM_DCH_H

#include "pair_dch.h"

namespace LAMMPS_NS {

/// lj/charmm/coul/long/dch. Of a pair of types there are epsilon and sigma, and those of 1-4 pairs, which
/// dihedrals compute.
class PairLJCharmmCoulLongDCH : public PairDCH {
 public:
  explicit PairLJCharmmCoulLongDCH(LAMMPS* lammps)
      : PairLJCharmmCoulLongDCH(lammps, "lj/charmm/coul/long", dch::PairForm::charmm) {}

 protected:
  PairLJCharmmCoulLongDCH(LAMMPS* lammps, const char* plain, dch::PairForm form)
      : PairDCH(lammps, {plain, form, dch::ChargeForm::ewald, 4}) {}

 private:
  void take_all(const double* all, dch::PairPotentialParams& params) const override {
    params.of_all = all[0];  // the inner cutoff, the outer one, that of charges
  }
  void take_pair(const double* all, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0], own[1]};
    pair.cutoff = all[1];
    pair.charge_cutoff = all[2];
  }
};

/// lj/charmmfsw/coul/long/dch, with the same numbers
class PairLJCharmmfswCoulLongDCH : public PairLJCharmmCoulLongDCH {
 public:
  explicit PairLJCharmmfswCoulLongDCH(LAMMPS* lammps)
      : PairLJCharmmCoulLongDCH(lammps, "lj/charmmfsw/coul/long", dch::PairForm::charmm_force) {}
};

/// lj/charmm/coul/charmm/dch
class PairLJCharmmCoulCharmmDCH : public PairDCH {
 public:
  explicit PairLJCharmmCoulCharmmDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"lj/charmm/coul/charmm", dch::PairForm::charmm, dch::ChargeForm::switched, 4}) {}

 private:
  void take_all(const double* all, dch::PairPotentialParams& params) const override {
    params.of_all = all[0];  // inner and outer cutoff, and those of charges
    params.switch_from = all[2];
  }
  void take_pair(const double* all, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0], own[1]};
    pair.cutoff = all[1];
    pair.charge_cutoff = all[3];
  }
};

}  // namespace LAMMPS_NS

#endif
