// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include <dch/cluster_pairs.hpp>
#include <dch/pair_list.hpp>
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

/// How charges act on each other within a cutoff: with the energy constant q_i q_j / r or, where `splitting`
/// is positive, with what an Ewald sum leaves to pairs, constant q_i q_j erfc(splitting r) / r. erfc is taken
/// from formula 7.1.26 of Abramowitz and Stegun, Handbook of Mathematical Functions (1964), as in LAMMPS:
/// within 1.5e-7.
struct CoulombTerm {
  double constant = 1;          ///< >= 0 [energy length / charge^2]
  double splitting = 0;         ///< >= 0 [1/length]
  std::vector<double> cutoffs;  ///< >= 0, for all pairs of types as Lennard-Jones pairs are given [length]
};

/// Sums over the pairs, each counted once.
struct LennardJonesSums {
  double energy = 0;               ///< [energy]
  double coulomb_energy = 0;       ///< of charges [energy]
  std::array<double, 6> virial{};  ///< sum of r_ij f_ij: xx, yy, zz, xy, xz, yz [energy]
};

/// The truncated Lennard-Jones potential on cluster pairs, alone or with charges, with SIMD kernels for the
/// instruction set in use.
///
/// Every pair in the masks of the ClusterPairs acts, at its distance now, if that is below the cutoff. Forces
/// of different instruction sets differ by rounding (fused operations, order of sums); those of one set are
/// the same every time. One object belongs to one thread at a time; it keeps scratch memory of 96 bytes a
/// cluster, 128 with charges.
class LennardJones {
 public:
  /// One type. With `shifted` each pair's energy is lowered by what it is at the cutoff.
  /// @throws InvalidParameter for a negative or non-finite sigma or cutoff, a non-finite epsilon, and
  ///   coefficients beyond double precision.
  explicit LennardJones(LennardJonesPair pair, bool shifted = false);
  /// A symmetric matrix of pairs of types, row-major, types x types.
  /// @throws as above, and InvalidParameter if the matrix is not square or not symmetric.
  LennardJones(int types, const std::vector<LennardJonesPair>& matrix, bool shifted = false);

  /// Has charges act too.
  /// @throws InvalidParameter for a negative or non-finite number, another number of cutoffs than pairs of
  ///   types, and cutoffs that are not symmetric.
  void set_coulomb(const CoulombTerm& term);

  int types() const { return types_; }
  /// Of charges too.
  double largest_cutoff() const { return largest_cutoff_; }

  /// Adds the force on each particle to `forces`, which is indexed as the positions were [energy/length].
  /// O(entries).
  /// @param charges one per particle, or none if no CoulombTerm was set [charge]
  /// @throws InvalidParameter if forces or charges are not one per particle, if the cutoff exceeds the radius
  ///   that the pairs were made for, if they have more types than this, or if the coefficients leave the
  ///   range of single precision and `precision` is mixed.
  void add_forces(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                  Span<const double> charges = {});
  /// The same, with energy and virial: a quarter slower.
  LennardJonesSums add_forces_and_sum(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                                      Span<const double> charges = {});

  /// The same for pairs one by one, always in double precision.
  /// @param positions of the particles now, which have not been wrapped since the list was made [length]
  /// @param now the cell now; of the same periodicity
  /// @throws InvalidParameter as above, and if positions are not one per particle; InvalidBox for another
  ///   periodicity
  void add_forces(const PairList& pairs, Span<const Vec3> positions, const Box& now, Span<Vec3> forces,
                  Span<const double> charges = {}) const;
  LennardJonesSums add_forces_and_sum(const PairList& pairs, Span<const Vec3> positions, const Box& now,
                                      Span<Vec3> forces, Span<const double> charges = {}) const;

 private:
  template <class Real>
  struct alignas(4 * sizeof(Real)) FourCharges {
    Real q[4];
  };
  /// Scratch memory for one precision.
  template <class Real>
  struct Scratch {
    std::vector<ClusterOfFour<Real>> force;
    std::vector<FourCharges<Real>> charge;
  };
  /// Each for all pairs of types: cutoff2, force12, force6, energy12, energy6, energy_shift, coulomb_cutoff2.
  template <class Real>
  using Tables = std::array<std::vector<Real>, 7>;

  void add(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces, Span<const double> charges,
           LennardJonesSums* sums);
  template <class Real>
  void run(const ClusterPairs& pairs, Span<const double> charges, const Tables<Real>& tables,
           Scratch<Real>& scratch, Span<Vec3> forces, LennardJonesSums* sums) const;
  void add(const PairList& pairs, Span<const Vec3> positions, const Box& now, Span<Vec3> forces,
           Span<const double> charges, LennardJonesSums* sums) const;
  /// Of ClusterPairs or a PairList.
  template <class Pairs>
  void check(const Pairs& pairs, std::size_t forces, std::size_t charges) const;

  int types_ = 1;
  double largest_cutoff_ = 0;
  bool fits_single_ = true;  ///< whether single precision can hold the coefficients
  bool has_charges_ = false;
  double charge_unit_ = 1, splitting_ = 0;  ///< the former squared is the CoulombTerm's constant
  Tables<double> full_;
  Tables<float> mixed_;
  Scratch<double> scratch_;
  Scratch<float> scratch_float_;
};

}  // namespace dch
