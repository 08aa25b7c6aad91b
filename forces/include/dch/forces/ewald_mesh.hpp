// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// What a lattice sum is of.
enum class LatticeSum { coulomb, dispersion };

/// The part of a lattice sum in reciprocal space, on a mesh: smooth particle mesh Ewald (Essmann,
/// Perera, Berkowitz, Darden, Lee and Pedersen, J. Chem. Phys. 103:8577, 1995) with splines of order 5.
///
/// The energy is that of each pair and all its images, constant q_i q_j erf(splitting r) / r, and of each
/// charge with itself, constant splitting / sqrt(pi) q_i^2, which a caller takes away. Of dispersion, with
/// coefficients c for charges, it is -constant c_i c_j (1 - e^(-x^2) (1 + x^2 + x^4 / 2)) / r^6, x =
/// splitting r, and of each with itself -constant splitting^6 / 12 c_i^2. The mesh is in single precision:
/// beside the error that its sizes leave, forces are within 3e-6 of their root mean square. Forces and energy
/// have the same bits on any number of threads. The Fourier transforms are of this library.
///
/// One object belongs to one thread at a time. It keeps the influence function for as long as the box stays.
/// It takes about 12 bytes a point of the mesh and 236 bytes a charge.
class EwaldMesh {
 public:
  /// @param sizes  points of the mesh along the cell's vectors, at least 5; each is raised to the next number
  ///   without prime factors other than 2, 3, 5 and 7
  /// @param splitting  > 0 [1/length]
  /// @param constant  >= 0 [energy length / charge^2, or of dispersion energy length^6 / coefficient^2]
  /// @throws InvalidParameter for numbers outside of these, and sizes above 10,000
  EwaldMesh(std::array<int, 3> sizes, double splitting, double constant, LatticeSum of = LatticeSum::coulomb);
  ~EwaldMesh();
  EwaldMesh(EwaldMesh&&) noexcept;
  EwaldMesh& operator=(EwaldMesh&&) noexcept;

  /// Threads to use; null for that of the caller alone. Not owned.
  void set_executor(Executor* executor);
  std::array<int, 3> sizes() const;

  /// Adds the force on each charge to `forces` [energy/length] and returns the energy. O(n + m log m) for n
  /// charges and m points.
  /// @param positions  in any image [length]
  /// @throws InvalidParameter unless there is one charge and one force for each position; InvalidBox unless
  ///   the box is periodic along all vectors; InvalidPosition for one that is not finite
  double add_forces(Span<const Vec3> positions, Span<const double> charges, const Box& box,
                    Span<Vec3> forces);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch
#pragma GCC visibility pop
