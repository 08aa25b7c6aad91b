// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/forces/fene.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// A spring of energy k (r - r0)^2.
struct HarmonicBond {
  double k = 30;  ///< [energy/length^2]
  double r0 = 1;  ///< [length]
};

/// Forces of such bonds, with SIMD kernels for the instruction set in use.
class HarmonicForces {
 public:
  /// @param types of bonds
  /// @throws InvalidParameter for numbers that are not finite.
  explicit HarmonicForces(const std::vector<HarmonicBond>& types);

  /// Adds the force on each particle. Bonds are between the positions as given, without images; one of length
  /// 0 has no direction and no force.
  /// @param first_type number of the first type in the bonds
  /// @param virial sum of r_ij f_ij over the bonds: xx, yy, zz, xy, xz, yz; added to unless it is null
  ///   [energy]
  /// @throws InvalidParameter if there are not as many positions as forces. Particles and types of bonds are
  ///   not checked.
  void add_forces(Span<const BondOfType> bonds, int first_type, Span<const Vec3> positions, Span<Vec3> forces,
                  std::array<double, 6>* virial = nullptr) const;

 private:
  std::array<std::vector<double>, 2> tables_;  ///< by type: 2 k, r0
};

}  // namespace dch
#pragma GCC visibility pop
