// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include <dch/cluster_pairs.hpp>
#include <dch/span.hpp>
#include <dch/vec3.hpp>

namespace dch {

/// How pairs are computed.
enum class ForcePrecision {
  mixed,  ///< pairs in single precision, sums of energy and virial in double: forces are off by about 1.5e-6
          ///< of their root mean square
  full    ///< all in double: by a few 1e-15
};

/// Energy 4 epsilon ((sigma/r)^12 - (sigma/r)^6) of a pair with r < cutoff, else 0.
struct LennardJonesPair {
  double epsilon = 1;  ///< [energy]
  double sigma = 1;    ///< >= 0 [length]
  double cutoff = 0;   ///< >= 0; the pair does not interact if it is 0 [length]
};

/// Sums over the pairs, each counted once.
struct LennardJonesSums {
  double energy = 0;               ///< [energy]
  std::array<double, 6> virial{};  ///< sum of r_ij f_ij: xx, yy, zz, xy, xz, yz [energy]
};

/// The truncated Lennard-Jones potential on cluster pairs, with SIMD kernels for the instruction set in use.
///
/// Every pair in the masks of the ClusterPairs acts, at its distance now, if that is below the cutoff. Forces
/// of different instruction sets differ by rounding (fused operations, order of sums); those of one set are
/// the same every time. One object belongs to one thread at a time; it keeps scratch memory of 96 bytes a
/// cluster.
class LennardJones {
 public:
  /// One type. With `shifted` each pair's energy is lowered by what it is at the cutoff.
  /// @throws InvalidParameter for a negative or non-finite sigma or cutoff, a non-finite epsilon, and
  ///   coefficients beyond double precision.
  explicit LennardJones(LennardJonesPair pair, bool shifted = false);
  /// A symmetric matrix of pairs of types, row-major, types x types.
  /// @throws as above, and InvalidParameter if the matrix is not square or not symmetric.
  LennardJones(int types, const std::vector<LennardJonesPair>& matrix, bool shifted = false);

  int types() const { return types_; }
  double largest_cutoff() const { return largest_cutoff_; }

  /// Adds the force on each particle to `forces`, which is indexed as the positions were [energy/length].
  /// O(entries).
  /// @throws InvalidParameter if forces are not one per particle, if the cutoff exceeds the radius that the
  ///   pairs were made for, if they have more types than this, or if the coefficients leave the range of
  ///   single precision and `precision` is mixed.
  void add_forces(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces);
  /// The same, with energy and virial: a quarter slower.
  LennardJonesSums add_forces_and_sum(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces);

 private:
  /// Each for all pairs of types: cutoff2, force12, force6, energy12, energy6, energy_shift.
  template <class Real>
  using Tables = std::array<std::vector<Real>, 6>;

  void add(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces, LennardJonesSums* sums);
  void check(const ClusterPairs& pairs, ForcePrecision precision, std::size_t forces) const;

  int types_ = 1;
  double largest_cutoff_ = 0;
  bool fits_single_ = true;  ///< whether single precision can hold the coefficients
  Tables<double> full_;
  Tables<float> mixed_;
  std::vector<ClusterOfFour<double>> force_;
  std::vector<ClusterOfFour<float>> force_float_;
};

}  // namespace dch
