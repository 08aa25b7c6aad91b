// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/clusters/cluster_pairs.hpp>

#pragma GCC visibility push(default)
namespace dch {

namespace detail {
struct BornConstants;
struct BornKernels;
struct BornTask;
}  // namespace detail

/// What integrals of generalized Born models are made of. With a the radius of a particle, s the scaled
/// radius of another one at distance r < cutoff, U = r + s and L = max(a, |r - s|), the integral I of the
/// first grows by
///     1/2 (1/L - 1/U + 1/4 (r - s^2/r) (1/U^2 - 1/L^2) + 1/2 log(L/U) / r)   where a < U, else by 0
/// (Hawkins, Cramer and Truhlar, J. Phys. Chem. 100:19824, 1996).
struct BornParticle {
  double radius = 0;  ///< > 0 [length]
  double scaled = 0;  ///< of either sign [length]
};

/// Necks between particles (Mongan, Simmerling, McCammon, Case and Onufriev, J. Chem. Theory Comput. 3:156,
/// 2007): I grows by scale h / (1 + 100 (r - d)^2 + 3e5 (r - d)^6) too, where r < radius + radius + reach.
struct BornNecks {
  int kinds = 0;                   ///< of particles
  std::vector<double> at, height;  ///< d and h: kinds x kinds, the kind of the particle whose I grows first
  double scale = 0, reach = 0;     ///< the latter [length]
  std::vector<std::int32_t> kind;  ///< of each particle, 0 .. kinds - 1
};

/// The energy of two charges, with their Born radii B:
///     -constant q q (1/solute - exp(-kappa f) / solvent) (1/f - shift),  f^2 = r^2 + B B exp(-r^2 / (4 B B))
/// where r < cutoff (Still, Tempczyk, Hawley and Hendrickson, J. Am. Chem. Soc. 112:6127, 1990).
struct BornEnergy {
  double constant = 1;                       ///< [energy length / charge^2]
  double over_solute = 1, over_solvent = 1;  ///< 1/solute and 1/solvent
  double kappa = 0, shift = 0;               ///< >= 0 [1/length]
};

/// The sums over pairs of generalized Born models on cluster pairs, in single precision, with SIMD kernels
/// for the instruction set in use: forces are off by about 1e-6 of their root mean square. What belongs to
/// single particles, the Born radii among it, is the caller's.
///
/// Every pair in the masks of the ClusterPairs acts, at its distance now, if that is below the cutoff;
/// particles at the same place count as at their limit. Results of one instruction set are the same every
/// time, on any number of threads. One object belongs to one thread at a time; it keeps scratch memory of
/// about 400 bytes a cluster for each thread.
class BornSums {
 public:
  /// @param counts_inside  whether I grows by 1/a - 1/L more where a < s - r: inside of the other particle
  /// @throws InvalidParameter for a cutoff or radius that is not positive and finite, and for a scaled radius
  ///   that is not finite.
  BornSums(double cutoff, Span<const BornParticle> particles, bool counts_inside);

  /// @throws InvalidParameter for tables and kinds that do not fit each other and the particles.
  void set_necks(BornNecks necks);
  void set_executor(Executor* executor) { executor_ = executor; }
  /// Whether single precision serves: radii differ by less than a factor of 1,000.
  bool fits_single() const { return fits_single_; }

  /// Adds I of each particle. O(entries), as the others.
  /// @throws InvalidParameter if numbers are not one per particle or the cutoff exceeds the radius that the
  ///   pairs were made for; so do the others.
  void add_integrals(const ClusterPairs& pairs, Span<double> integrals);
  /// Adds the forces at constant Born radii, and dE/dB of each particle. Returns the energy, 0 unless wanted.
  double add_energies(const ClusterPairs& pairs, const BornEnergy& energy, Span<const double> charges,
                      Span<const double> born_radii, Span<Vec3> forces, Span<double> slopes,
                      bool wants_energy);
  /// Adds the forces -dE/dI dI/dr.
  void add_chain(const ClusterPairs& pairs, Span<const double> slopes, Span<Vec3> forces);

 private:
  struct alignas(16) FourNumbers {
    float slot[4];
  };
  struct alignas(64) Lanes {
    float numbers[64];
  };
  /// What a thread finds for its task; all 0 between calls.
  struct Worker {
    std::vector<ClusterOfFour<float>> force, scalar;
    std::vector<Lanes> lanes;
  };
  using Slots = std::vector<FourNumbers>;

  void check(const ClusterPairs& pairs, std::initializer_list<std::size_t> sizes) const;
  void prepare(const ClusterPairs& pairs);
  detail::BornConstants constants() const;
  static void sort(const ClusterPairs& pairs, Span<const double> numbers, Slots& slots, float padding);
  void sort_kinds(const ClusterPairs& pairs);
  static const detail::BornKernels& kernels();
  detail::BornConstants constants_of(const BornEnergy& energy) const;
  detail::BornTask task_of(const ClusterPairs& pairs, const detail::BornConstants& constants) const;
  void make_room(std::size_t workers, std::size_t clusters);
  void hand_out(const ClusterPairs& pairs, ClusterPairs::Range own, Worker& found, Span<Vec3> forces,
                Span<double> scalars);
  /// Runs the kernel over each task and gives forces and scalars to particles, where they are wanted. Returns
  /// the sum of what kernels return.
  template <class Kernel>
  double run(const ClusterPairs& pairs, const detail::BornConstants& constants, const Kernel& kernel,
             Span<Vec3> forces, Span<double> scalars);

  double cutoff_;
  bool counts_inside_, fits_single_ = true;
  double largest_radius_ = 0, largest_scaled_ = 0;
  std::vector<double> radii_, scaled_;
  BornNecks necks_;
  std::vector<float> neck_tables_[4];  ///< at, height; the same transposed
  Executor* executor_ = nullptr;

  Slots radius_slots_, scaled_slots_, charge_slots_, born_slots_, half_slots_, slope_slots_;
  std::vector<std::int32_t> kind_slots_;
  std::vector<Worker> workers_;
  std::vector<ClusterOfFour<float>> earlier_force_, earlier_scalar_;
  std::vector<double> half_over_, scalars_;
};

}  // namespace dch
#pragma GCC visibility pop
