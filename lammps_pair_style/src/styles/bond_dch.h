// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <bond.h>

#include <dch/forces/fene.hpp>

#include "bonded_dch.h"

namespace LAMMPS_NS {

/// A bond style whose forces come from a SIMD kernel.
class BondDCH : public BondedDCH<Bond> {
 public:
  double equilibrium_distance(int type) override;
  double single(int type, double rsq, int i, int j, double& fforce) override;
  void* extract(const char* name, int& dimension) override;
  void reinit() override;

 protected:
  /// @param plain_style the plain style's name
  /// @param coefficients how many numbers a type has
  BondDCH(LAMMPS* lammps, const char* plain_style, std::size_t coefficients);

  /// Those that this process computes.
  dch::Span<const dch::BondOfType> bonds() const;

 private:
  int types() const override;
  int bonds_here() const override;
};

}  // namespace LAMMPS_NS
