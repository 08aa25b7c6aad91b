// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// A spring between two bonds that meet: energy k (theta - theta0)^2 of the angle theta between them.
struct HarmonicAngle {
  double k = 10;                        ///< [energy/radian^2]
  double theta0 = 3.14159265358979324;  ///< [radian]
};

/// Two bonds that rather form a straight line, as in semiflexible chains: energy k (1 + cos theta).
struct CosineAngle {
  double k = 2;  ///< [energy]
};

/// Three particles and the type of the angle at the second.
struct AngleOfType {
  std::int32_t i, apex, k, type;
};

/// Forces of such angles, with SIMD kernels for the instruction set in use.
class AngleForces {
 public:
  /// @param types of angles
  /// @throws InvalidParameter for numbers that are not finite.
  explicit AngleForces(const std::vector<HarmonicAngle>& types);
  explicit AngleForces(const std::vector<CosineAngle>& types);

  /// Adds the force on each particle. Bonds are between the positions as given, without images. Where one of
  /// the two has length 0 there is no angle and no force. The angle itself is good to rounding whatever it
  /// is, since it comes of sine and cosine. The force of a harmonic angle is divided by its sine, of which
  /// less than 0.001 counts as 0.001, as in LAMMPS.
  /// @param first_type number of the first type in the angles
  /// @param virial sum of r f over both bonds of each angle, from the apex: xx, yy, zz, xy, xz, yz; added to
  ///   unless it is null [energy]
  /// @throws InvalidParameter if there are not as many positions as forces. Particles and types of angles are
  ///   not checked.
  void add_forces(Span<const AngleOfType> angles, int first_type, Span<const Vec3> positions,
                  Span<Vec3> forces, std::array<double, 6>* virial = nullptr) const;

 private:
  bool is_harmonic_;
  std::array<std::vector<double>, 2> tables_;  ///< by type: 2 k and theta0, or k alone
};

}  // namespace dch
#pragma GCC visibility pop
