// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <angle.h>
#include <optional>

#include <dch/forces/angles.hpp>

#include "bonded_dch.h"

namespace LAMMPS_NS {

/// An angle style whose forces come from a SIMD kernel.
class AngleDCH : public BondedDCH<Angle> {
 public:
  double equilibrium_angle(int type) override;
  double single(int type, int i, int apex, int k) override;

 protected:
  /// @param plain_style the plain style's name
  /// @param coefficients how many numbers a type has
  AngleDCH(LAMMPS* lammps, const char* plain_style, std::size_t coefficients);

  std::optional<dch::AngleForces> kernel_;  ///< made by the style

 private:
  int types() const override;
  int bonds_here() const override;
  void add_forces(dch::Span<const dch::Vec3> positions, dch::Span<dch::Vec3> forces, bool wants_virial,
                  std::array<double, 6>& sums) override;
  void copy_more_sums(int atoms) override;
};

}  // namespace LAMMPS_NS
