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
#include <dch/forces/lennard_jones.hpp>
#include <dch/lists/pair_list.hpp>

#pragma GCC visibility push(default)
namespace dch {

namespace detail {
struct FormKernels;
template <class Real>
struct LjCoefficients;
}  // namespace detail

/// How the energy of a pair depends on its distance, with the numbers that it has for each pair of types, and
/// one for all.
enum class PairForm {
  lennard_jones,  ///< 4 epsilon ((sigma/r)^12 - (sigma/r)^6): epsilon, sigma
  charmm,         ///< the same times (c^2 - r^2)^2 (c^2 + 2 r^2 - 3 f^2) / (c^2 - f^2)^3 where r exceeds f:
                  ///< epsilon, sigma; for all f; c is the cutoff, the same for all
  charmm_force,   ///< lennard_jones whose force is multiplied by that factor, and another energy, of which it
                  ///< is not the slope, as in LAMMPS's lj/charmmfsw: epsilon, sigma; for all f
  expanded,       ///< lennard_jones at r - delta: epsilon, sigma, delta
  buckingham,     ///< a e^(-r/rho) - c / r^6: a, rho, c
  morse,          ///< d (e^(-2 alpha (r - r0)) - 2 e^(-alpha (r - r0))): d, alpha, r0
  soft,           ///< a (1 + cos(pi r / cutoff)): a
  yukawa,         ///< a e^(-kappa r) / r: a; for all kappa
  table,          ///< a PairTable, linear between knots: its number, from 0
  spline,         ///< a PairTable of cubic splines: its number, from 0
  colloid  ///< spheres made of Lennard-Jones particles, and such particles, by Everaers and Ejtehadi, Phys.
           ///< Rev. E 67, 041710 (2003): A (Hamaker) [energy], sigma, diameters d1 and d2 [length], both >=
           ///< 0, 0 of a particle. Where spheres overlap, or a particle's center is within a sphere, forces
           ///< are not finite
};

/// How charges act beside, all with the constant: not at all, as q_i q_j / r, as what an Ewald sum leaves to
/// pairs, q_i q_j erfc(splitting r) / r, as that less its value and slope at the cutoff, or as q_i q_j / r
/// multiplied, force and energy, by the factor of PairForm::charmm, as in LAMMPS. erfc is taken from
/// formula 7.1.26 of Abramowitz and Stegun, Handbook of Mathematical Functions (1964), as in LAMMPS:
/// within 1.5e-7.
enum class ChargeForm { none, bare, ewald, damped_shifted, switched };

/// A pair of types.
struct FormPair {
  std::array<double, 4> numbers{};  ///< as PairForm names them
  double cutoff = 0;                ///< >= 0; the form does not act if it is 0 [length]
  double charge_cutoff = 0;         ///< >= 0; of charges, the same [length]
  double left_at_cutoff = 0;        ///< what is left of a shifted energy there [energy]
};

/// A force and an energy between knots that are equally far from each other in r^2: linear in r^2, or cubic
/// splines of it. Pairs closer than the first knot have no number (NaN) as their force and energy. The force
/// need not be the slope of the energy.
struct PairTable {
  double inner = 0, outer = 0;  ///< distances of the first knot and of the last, 0 <= inner < outer [length]
  std::vector<double> force_over_r, energy;  ///< at the knots; two or more, and as many of each
  /// Second derivatives of both by r^2 at the knots, as many, of PairForm::spline; else none.
  std::vector<double> force_bend{}, energy_bend{};
};

struct PairPotentialParams {
  PairForm form = PairForm::lennard_jones;
  ChargeForm charges = ChargeForm::none;
  int types = 1;
  std::vector<FormPair> pairs;    ///< symmetric matrix of pairs of types, row-major
  std::vector<PairTable> tables;  ///< of table and spline; no cutoff is beyond the last knot
  double of_all = 0;              ///< the form's number for all pairs
  double constant = 1;            ///< of charges, >= 0 [energy length / charge^2]
  double splitting = 0;           ///< of charges, >= 0 [1/length]
  double switch_from = 0;         ///< of charges, where they are switched off [length]
  bool shifted = false;  ///< whether each pair's energy by its form is lowered, by what it is at the cutoff
                         ///< less left_at_cutoff; nothing changes where that is 0
};

/// Pairs that act by a part only: bonded ones.
struct WeightedPairs {
  Span<const std::int32_t> i, j;   ///< that forces act on
  Span<const std::int32_t> at;     ///< whose position j has, an image of it
  Span<const std::int32_t> types;  ///< where the pair of types stands in the matrix
  Span<const std::int32_t> kind;   ///< 0 to 3
  std::array<double, 4> weight{};  ///< of each kind
  /// The same of charges. What is left out of those that an Ewald sum knows, or that act damped and shifted,
  /// is a part of q_i q_j / r.
  std::array<double, 4> charge_weight{};
};

/// A few pairs whose distances are known, and what they add. Those that are none keep r2.
struct alignas(64) PairBatch {
  static constexpr int kSize = 16;
  double r2[kSize], charges[kSize]{};  ///< squared distance, product of charges
  double force_over_r[kSize], energy[kSize], coulomb_energy[kSize];
  std::int32_t types[kSize]{}, kind[kSize]{};  ///< as WeightedPairs has them
  PairBatch() {
    for (double& far : r2) far = 1e300;
  }
};

/// A pair potential on cluster pairs, with SIMD kernels for the instruction set in use: of a form, and of a
/// way in which charges act. As to masks, threads, precision and repeated results it is as LennardJones.
/// Tallies by particle take 256 bytes a cluster more for each thread and once more; in mixed precision those
/// of a pair are computed in single precision, and summed up in it within a row of clusters.
class PairPotential {
 public:
  /// @throws InvalidParameter for numbers that are not finite, negative or asymmetric cutoffs, a form that
  ///   does not go with these charges, numbers beyond double precision, and tables other than PairTable says.
  explicit PairPotential(const PairPotentialParams& params);

  void set_executor(Executor* executor) { executor_ = executor; }
  bool has_charges() const { return params_.charges != ChargeForm::none; }
  /// Whether single precision can hold the numbers.
  bool fits_single() const { return fits_single_; }
  /// Of charges too.
  double largest_cutoff() const { return largest_cutoff_; }

  /// As LennardJones's functions.
  void add_forces(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                  Span<const double> charges = {});
  LennardJonesSums add_forces_and_sum(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                                      Span<const double> charges = {});
  /// The same, and for each particle the sums over its pairs, half of each, as LAMMPS divides them.
  /// @param halves  by particle, added to
  /// @throws InvalidParameter also if there is not room for one per particle
  LennardJonesSums add_forces_and_tally(const ClusterPairs& pairs, ForcePrecision precision,
                                        Span<Vec3> forces, Span<LennardJonesSums> halves,
                                        Span<const double> charges = {});
  void add_forces(const PairList& pairs, Span<const Vec3> positions, const Box& now, Span<Vec3> forces,
                  Span<const double> charges = {}) const;
  LennardJonesSums add_forces_and_sum(const PairList& pairs, Span<const Vec3> positions, const Box& now,
                                      Span<Vec3> forces, Span<const double> charges = {}) const;
  LennardJonesSums add_forces_and_tally(const PairList& pairs, Span<const Vec3> positions, const Box& now,
                                        Span<Vec3> forces, Span<LennardJonesSums> halves,
                                        Span<const double> charges = {}) const;
  /// Pairs with weights, in double precision. Positions, forces and charges are by particle, as many as pairs
  /// name.
  /// @param sums  added to; null if not wanted
  /// @param halves  by particle, as above; none if not wanted
  void add_weighted(const WeightedPairs& pairs, Span<const Vec3> positions, Span<Vec3> forces,
                    Span<const double> charges, LennardJonesSums* sums,
                    Span<LennardJonesSums> halves = {}) const;
  /// Computes the pairs of a batch.
  void compute(PairBatch& pairs, const std::array<double, 4>& weight,
               const std::array<double, 4>& charge_weight) const;
  /// Energy of a charge by itself, divided by its square: what is left of its own image at the cutoff where
  /// charges are damped and shifted, else 0 (Fennell and Gezelter 2006, eq. 19).
  double self_energy() const { return self_energy_; }

 private:
  template <class Real>
  using Tables = std::array<std::vector<Real>, 7>;

  bool has_tables() const { return params_.form == PairForm::table || params_.form == PairForm::spline; }
  /// Tables side by side, as TableForm or SplineForm has them.
  template <class Real>
  struct Knots {
    std::vector<Real> force, energy;
  };

  void take_tables();
  std::array<double, 4> given_to_form(const FormPair& pair) const;
  void take_pair(std::size_t a, std::size_t b);
  void take_charges();
  void take_way();
  void find_mixing();
  double energy_at(std::size_t k, double r) const;
  template <class Pairs>
  void check(const Pairs& pairs, std::size_t forces, std::size_t charges) const;
  template <class Real>
  void run(const ClusterPairs& pairs, const Tables<Real>& tables, detail::ClusterScratch<Real>& scratch,
           Span<Vec3> forces, Span<const double> charges, LennardJonesSums* sums,
           Span<LennardJonesSums> halves) const;
  void add(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces, Span<const double> charges,
           LennardJonesSums* sums, Span<LennardJonesSums> halves);
  void add(const PairList& pairs, Span<const Vec3> positions, const Box& now, Span<Vec3> forces,
           Span<const double> charges, LennardJonesSums* sums, Span<LennardJonesSums> halves) const;
  template <class Real>
  detail::LjConstants<Real> constants() const;

  PairPotentialParams params_;
  double largest_cutoff_ = 0, self_energy_ = 0, charge_unit_ = 1;
  bool fits_single_ = true;
  std::array<double, 7> of_form_{};
  std::array<double, 3> of_charges_{};
  /// Numbers of types of which pairs are mixed (LennardJonesParticle); empty unless they are, and tables
  /// would not fit into registers.
  std::vector<double> half_sigma_, root_epsilon_;
  std::vector<std::array<double, 4>> given_of_table_;
  Knots<double> knots_;
  Knots<float> knots_float_;
  Executor* executor_ = nullptr;
  Tables<double> full_;
  Tables<float> mixed_;
  detail::ClusterScratch<double> scratch_;
  detail::ClusterScratch<float> scratch_float_;
};

}  // namespace dch
#pragma GCC visibility pop
