// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(lj/cut/dch,PairLJCutDCH);
PairStyle(lj/cut/coul/cut/dch,PairLJCutCoulCutDCH);
PairStyle(lj/cut/coul/long/dch,PairLJCutCoulLongDCH);
PairStyle(lj/cut/coul/dsf/dch,PairLJCutCoulDSFDCH);
PairStyle(lj/expand/dch,PairLJExpandDCH);
// clang-format on
#elif !defined(LMP_PAIR_LJ_DCH_H)
#define LMP_PAIR_LJ_DCH_H

#include "pair_dch.h"

namespace LAMMPS_NS {

/// lj/cut/dch
class PairLJCutDCH : public PairDCH {
 public:
  explicit PairLJCutDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"lj/cut", dch::PairForm::lennard_jones, dch::ChargeForm::none, 3}) {}

 private:
  void take_pair(const double*, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0], own[1]};  // epsilon, sigma
    pair.cutoff = own[2];
  }
};

/// lj/cut/coul/cut/dch
class PairLJCutCoulCutDCH : public PairDCH {
 public:
  explicit PairLJCutCoulCutDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"lj/cut/coul/cut", dch::PairForm::lennard_jones, dch::ChargeForm::bare, 4}) {}

 private:
  void take_pair(const double*, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0], own[1]};
    pair.cutoff = own[2];
    pair.charge_cutoff = own[3];
  }
};

/// lj/cut/coul/long/dch
class PairLJCutCoulLongDCH : public PairDCH {
 public:
  explicit PairLJCutCoulLongDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"lj/cut/coul/long", dch::PairForm::lennard_jones, dch::ChargeForm::ewald, 3}) {}

 private:
  void take_pair(const double* all, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0], own[1]};
    pair.cutoff = own[2];
    pair.charge_cutoff = all[1];  // behind the global cutoff of Lennard-Jones
  }
};

/// lj/cut/coul/dsf/dch
class PairLJCutCoulDSFDCH : public PairDCH {
 public:
  explicit PairLJCutCoulDSFDCH(LAMMPS* lammps)
      : PairDCH(lammps,
                {"lj/cut/coul/dsf", dch::PairForm::lennard_jones, dch::ChargeForm::damped_shifted, 3}) {}

 private:
  void take_all(const double* all, dch::PairPotentialParams& params) const override {
    params.splitting = all[0];  // alpha, the global cutoff of Lennard-Jones, that of charges
  }
  void take_pair(const double* all, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0], own[1]};
    pair.cutoff = own[2];
    pair.charge_cutoff = all[2];
  }
};

/// lj/expand/dch
class PairLJExpandDCH : public PairDCH {
 public:
  explicit PairLJExpandDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"lj/expand", dch::PairForm::expanded, dch::ChargeForm::none, 4}) {}

 private:
  void take_pair(const double*, const double* own, dch::FormPair& pair) const override {
    pair.numbers = {own[0], own[1], own[2]};  // epsilon, sigma, delta
    pair.cutoff = own[3] + own[2];            // the cutoff is one of r - delta
  }
};

}  // namespace LAMMPS_NS

#endif
