// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/clusters/cluster_pairs.hpp>
#include <dch/forces/cluster_scratch.hpp>
#include <dch/lists/pair_list.hpp>

#pragma GCC visibility push(default)
namespace dch {

namespace detail {
enum class ForceKind;
enum class LjParameters;
template <class Real>
struct LjConstants;
}  // namespace detail

/// How pairs are computed.
enum class ForcePrecision {
  mixed,  ///< pairs in single precision, sums of energy and virial in double: forces are off by about 1.5e-6
          ///< of their root mean square
  double_precision,        ///< all in double: by a few 1e-15
  full = double_precision  ///< the name of before, for one version
};

/// Energy 4 epsilon ((sigma/r)^12 - (sigma/r)^6) of a pair with r < cutoff, else 0.
struct LennardJonesPair {
  double epsilon = 1;  ///< [energy]
  double sigma = 1;    ///< >= 0 [length]
  double cutoff = 0;   ///< >= 0; the pair does not interact if it is 0 [length]
};

/// The same of a single particle. A pair has the mean of its particles' sigma and the geometric mean of their
/// epsilon (the rules of Lorentz and Berthelot).
struct LennardJonesParticle {
  double epsilon = 1;  ///< >= 0 [energy]
  double sigma = 1;    ///< >= 0 [length]
};

/// How charges act on each other within a cutoff: with the energy constant q_i q_j / r or, where `splitting`
/// is positive, with what an Ewald sum leaves to pairs, constant q_i q_j erfc(splitting r) / r. erfc is taken
/// from formula 7.1.26 of Abramowitz and Stegun, Handbook of Mathematical Functions (1964), as in LAMMPS:
/// within 1.5e-7; or, where `by_series` asks for it and all cutoffs are one, from a series that is faster and
/// exact to rounding (in double precision to 2e-9 where splitting times cutoff is over 4.5). Where
/// `quadratic` or `offset` is not 0 they act in a reaction field, with the energy constant q_i q_j (1/r +
/// quadratic r^2 - offset) (Tironi, Sperb, Smith and van Gunsteren, J. Chem. Phys. 102:5451, 1995).
struct CoulombTerm {
  double constant = 1;          ///< >= 0 [energy length / charge^2]
  double splitting = 0;         ///< >= 0 [1/length]
  std::vector<double> cutoffs;  ///< >= 0, for all pairs of types as Lennard-Jones pairs are given [length]
  double quadratic = 0;         ///< [1/length^3]
  double offset = 0;            ///< [1/length]
  bool by_series = false;       ///< how an Ewald sum takes erfc
};

/// Dispersion by a lattice sum, of which a pair within the cutoff is a part: reciprocal space (EwaldMesh,
/// with LatticeSum::dispersion) holds -c_i c_j share / r^6 of any pair, share = 1 - e^(-x^2) (1 + x^2 + x^4 /
/// 2) with x = splitting r, and here it is taken away again, so that Lennard-Jones alone is left. The energy
/// of a pair is lowered by what it is at the cutoff, as Lennard-Jones's with `shifted` (Wennberg, Murtola,
/// Pall, Abraham, Hess and Lindahl, J. Chem. Theory Comput. 11:5737, 2015).
struct DispersionTerm {
  double splitting = 0;              ///< > 0 [1/length]
  std::vector<double> coefficients;  ///< c, one per particle [sqrt(energy) length^3]
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
/// the same every time, on any number of threads. One object belongs to one thread at a time; it keeps
/// scratch memory of 96 bytes a cluster for each thread and once more, with AVX-512 in single precision of
/// 256 and 64, and 32 a cluster with charges.
class LennardJones {
 public:
  /// One type. With `shifted` each pair's energy is lowered by what it is at the cutoff.
  /// @throws InvalidParameter for a negative or non-finite sigma or cutoff, a non-finite epsilon, and
  ///   coefficients beyond double precision.
  explicit LennardJones(LennardJonesPair pair, bool shifted = false);
  /// A symmetric matrix of pairs of types, row-major, types x types.
  /// @throws as above, and InvalidParameter if the matrix is not square or not symmetric.
  LennardJones(int types, const std::vector<LennardJonesPair>& matrix, bool shifted = false);
  /// Parameters of each particle, mixed pair by pair as they are met: for more kinds of particles than a
  /// table for pairs of types serves well, that is than four. For cluster pairs only.
  /// @throws InvalidParameter for a cutoff that is not positive and finite, for a negative or non-finite
  ///   sigma or epsilon.
  LennardJones(double cutoff, Span<const LennardJonesParticle> particles);

  /// Has charges act too.
  /// @throws InvalidParameter for a negative or non-finite number, another number of cutoffs than pairs of
  ///   types, and cutoffs that are not symmetric; for a reaction field beside an Ewald sum; for a reaction
  ///   field, a series, parameters of particles or a switch with cutoffs that are not all the same and that
  ///   of Lennard-Jones; for an Ewald sum without series with parameters of particles or a switch; for a
  ///   series where splitting times cutoff exceeds 6.
  void set_coulomb(const CoulombTerm& term);
  /// Multiplies the Lennard-Jones energy by 1 + t^3 (-10 + t (15 - 6 t)), t = (r - from) / (cutoff - from),
  /// where r > from: energy and force go to 0 smoothly at the cutoff. For cluster pairs only.
  /// @throws InvalidParameter unless 0 <= from < cutoff, and if the energy is shifted, cutoffs differ, that
  ///   of charges too, or charges act as in an Ewald sum without series.
  void set_switch(double from);
  /// Has dispersion act by a lattice sum, beside charges that do, which may all be 0. For cluster pairs only.
  /// @throws InvalidParameter for a splitting parameter that is not finite and positive or times the cutoff
  ///   over 6, for a coefficient that is not finite, unless a CoulombTerm is set that asks for a series, with
  ///   a switch, and where pairs are given by type but their energies are not shifted.
  void set_dispersion(const DispersionTerm& term);
  /// Threads to compute forces of cluster pairs with; null for that of the caller alone. Not owned.
  void set_executor(Executor* executor) { executor_ = executor; }
  /// Has each call for cluster pairs leave out forces that are not finite and write the particles that they
  /// are of, ascending, to a list; null (as at first) to have them added. Not owned. There are some where
  /// particles coincide, with parameters or without, and where single precision has no number; energy and
  /// virial are not finite then.
  void set_unresolved(std::vector<std::int32_t>* particles) { unresolved_ = particles; }

  int types() const { return types_; }
  /// Whether single precision can hold the coefficients and its series are long enough: else only
  /// ForcePrecision::double_precision is to be had.
  bool fits_single() const { return fits_single_; }
  /// The order of entries (ClusterPairs::order_entries()) that makes add_forces() faster with the present
  /// instruction set.
  static ClusterPairs::EntryOrder wanted_order(ForcePrecision precision);
  /// Of charges too.
  double largest_cutoff() const { return largest_cutoff_; }

  /// Adds the force on each particle to `forces`, which is indexed as the positions were [energy/length].
  /// O(entries).
  /// @param charges one per particle, or none if no CoulombTerm was set [charge]
  /// @throws InvalidParameter if forces, charges or coefficients are not one per particle, if the cutoff
  /// exceeds the radius
  ///   that the pairs were made for, if they have more types than this, or if `precision` is mixed and not
  ///   fits_single().
  void add_forces(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                  Span<const double> charges = {});
  /// The same, with energy and virial: a quarter slower.
  LennardJonesSums add_forces_and_sum(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                                      Span<const double> charges = {});

  /// The same for pairs one by one, always in double precision.
  /// @param positions of the particles now, which have not been wrapped since the list was made [length]
  /// @param now the cell now; of the same periodicity
  /// @throws InvalidParameter as above, if positions are not one per particle, and for a switch, a reaction
  ///   field, a series or parameters of particles; InvalidBox for another periodicity
  void add_forces(const PairList& pairs, Span<const Vec3> positions, const Box& now, Span<Vec3> forces,
                  Span<const double> charges = {}) const;
  LennardJonesSums add_forces_and_sum(const PairList& pairs, Span<const Vec3> positions, const Box& now,
                                      Span<Vec3> forces, Span<const double> charges = {}) const;

 private:
  /// Each for all pairs of types: cutoff2, force12, force6, energy12, energy6, energy_shift, coulomb_cutoff2.
  template <class Real>
  using Tables = std::array<std::vector<Real>, 7>;

  void take_matrix(const std::vector<LennardJonesPair>& matrix, bool shifted);
  void check_coulomb_kind(const CoulombTerm& term) const;
  void make_series(const CoulombTerm& term);
  void check_dispersion(const DispersionTerm& term) const;
  detail::ForceKind kind() const;
  detail::LjParameters parameters() const;
  template <class Real>
  detail::LjConstants<Real> constants() const;
  /// The one cutoff of all pairs, of charges too, or 0 if they differ.
  double common_cutoff() const;
  void add(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces, Span<const double> charges,
           LennardJonesSums* sums);
  template <class Real>
  void run(const ClusterPairs& pairs, Span<const double> charges, const Tables<Real>& tables,
           detail::ClusterScratch<Real>& scratch, Span<Vec3> forces, LennardJonesSums* sums) const;
  void add(const PairList& pairs, Span<const Vec3> positions, const Box& now, Span<Vec3> forces,
           Span<const double> charges, LennardJonesSums* sums) const;
  /// Of ClusterPairs or a PairList.
  template <class Pairs>
  void check(const Pairs& pairs, std::size_t forces, std::size_t charges) const;

  int types_ = 1;
  double largest_cutoff_ = 0;
  bool shifted_ = false;
  bool fits_single_ = true;
  bool has_charges_ = false, has_reaction_field_ = false, has_series_ = false;
  double charge_unit_ = 1, splitting_ = 0;  ///< the former squared is the CoulombTerm's constant
  double quadratic_ = 0, offset_ = 0;
  /// Of what reciprocal space holds of charges, by power: forces, energies; in double and in single
  /// precision.
  std::vector<double> force_series_, energy_series_, force_series_single_, energy_series_single_;
  bool has_dispersion_ = false;
  double dispersion_unit_ = 1;      ///< what coefficients are multiplied by
  std::vector<double> dispersion_;  ///< coefficients by particle
  /// The same of dispersion.
  std::vector<double> dispersion_force_, dispersion_energy_, dispersion_force_single_,
      dispersion_energy_single_;
  double switch_from_ = -1;                        ///< negative: there is no switch
  bool mixes_ = false;                             ///< parameters are those of particles
  std::vector<double> half_sigma_, root_epsilon_;  ///< by particle then; 4 epsilon of a pair is the product
  Executor* executor_ = nullptr;
  std::vector<std::int32_t>* unresolved_ = nullptr;
  Tables<double> full_;
  Tables<float> mixed_;
  detail::ClusterScratch<double> scratch_;
  detail::ClusterScratch<float> scratch_float_;
};

}  // namespace dch
#pragma GCC visibility pop
