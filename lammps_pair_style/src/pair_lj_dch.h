// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <memory>
#include <string>
#include <vector>

#include <dch/lennard_jones.hpp>

#include "pair_dch.h"

namespace LAMMPS_NS {

/// lj/cut/dch, lj/cut/coul/cut/dch and lj/cut/coul/long/dch
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

}  // namespace LAMMPS_NS
