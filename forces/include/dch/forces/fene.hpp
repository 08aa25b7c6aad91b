// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Finitely extensible bonds of Kremer and Grest (J. Chem. Phys. 92:5057, 1990): energy
/// -k r0^2 ln(1 - (r/r0)^2) / 2, and 4 epsilon ((sigma/r)^12 - (sigma/r)^6) + epsilon where r < 2^(1/6)
/// sigma.
struct FeneBond {
  double k = 30;       ///< [energy/length^2]
  double r0 = 1.5;     ///< > 0 [length]
  double epsilon = 1;  ///< [energy]
  double sigma = 1;    ///< >= 0 [length]
};

/// Two particles and the type of their bond.
struct BondOfType {
  std::int32_t i, j, type;
};

/// Forces of such bonds, with SIMD kernels for the instruction set in use.
class FeneForces {
 public:
  /// @param types of bonds
  /// @throws InvalidParameter for numbers that are not finite, a sigma < 0 and an r0 <= 0.
  explicit FeneForces(const std::vector<FeneBond>& types);

  /// Adds the force on each particle. Bonds are between the positions as given, without images. Bonds with
  /// 1 - (r/r0)^2 < 0.1, which a host may want to warn about and which break if they are longer than r0, get
  /// none; they are listed.
  /// @param first_type number of the first type in the bonds
  /// @param too_long numbers of the bonds that are left out; overwritten
  /// @param virial sum of r_ij f_ij over the bonds that are not left out: xx, yy, zz, xy, xz, yz; added to
  ///   unless it is null [energy]
  /// @throws InvalidParameter if there are not as many positions as forces. Particles and types of bonds are
  ///   not checked.
  void add_forces(Span<const BondOfType> bonds, int first_type, Span<const Vec3> positions, Span<Vec3> forces,
                  std::vector<std::int32_t>& too_long, std::array<double, 6>* virial = nullptr) const;

 private:
  std::array<std::vector<double>, 4> tables_;  ///< by type: k, 1/r0^2, sigma^2, 48 epsilon
};

}  // namespace dch
#pragma GCC visibility pop
