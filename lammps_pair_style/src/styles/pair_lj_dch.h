// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(lj/cut/dch,PairLJCutDCH);
PairStyle(lj/cut/coul/cut/dch,PairLJCutCoulCutDCH);
PairStyle(lj/cut/coul/long/dch,PairLJCutCoulLongDCH);
// clang-format on
#elif !defined(LMP_PAIR_LJ_DCH_H)
#define LMP_PAIR_LJ_DCH_H

#include <lammps_host.h>
#include <memory>
#include <string>
#include <vector>

#include <dch/forces/lennard_jones.hpp>

#include "pair_dch.h"

namespace LAMMPS_NS {

/// What lj/cut/dch and the same with charges have in common.
class PairLJDCH : public PairDCH {
 public:
  enum class Charges { none, cut, ewald };

  /// @param plain name of the plain style
  PairLJDCH(LAMMPS* lammps, std::string plain, Charges charges)
      : PairDCH(lammps, std::move(plain)), charges_(charges) {}

 protected:
  void make_kernel(const std::vector<PairOfTypes>& pairs) override;
  void add_forces(const ClusterList& wanted, dch::ForcePrecision precision, dch::Span<dch::Vec3> forces,
                  bool with_sums) override;
  bool has_charges() const override { return charges_ != Charges::none; }

 private:
  enum class Part { lennard_jones, coulomb };
  double cutoff_of(Part part, const PairOfTypes& pair) const;

  Charges charges_;
  std::unique_ptr<dch::LennardJones> kernel_;
};

/// lj/cut/dch
class PairLJCutDCH : public PairLJDCH {
 public:
  explicit PairLJCutDCH(LAMMPS* lammps) : PairLJDCH(lammps, "lj/cut", Charges::none) {}
};

/// lj/cut/coul/cut/dch
class PairLJCutCoulCutDCH : public PairLJDCH {
 public:
  explicit PairLJCutCoulCutDCH(LAMMPS* lammps) : PairLJDCH(lammps, "lj/cut/coul/cut", Charges::cut) {}
};

/// lj/cut/coul/long/dch
class PairLJCutCoulLongDCH : public PairLJDCH {
 public:
  explicit PairLJCutCoulLongDCH(LAMMPS* lammps) : PairLJDCH(lammps, "lj/cut/coul/long", Charges::ewald) {}
};

}  // namespace LAMMPS_NS

#endif
