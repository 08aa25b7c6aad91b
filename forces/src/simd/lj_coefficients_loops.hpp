// SPDX-License-Identifier: MIT
//
// Lennard-Jones coefficients of 16 pairs, over vector types; see cluster_loops.hpp.
#pragma once

#include "clusters/simd/cluster_loops.hpp"
#include "simd/lj_task.hpp"

namespace dch::detail {
namespace {

enum Coefficient {
  kCutoff2,
  kForce12,
  kForce6,
  kEnergy12,
  kEnergy6,
  kEnergyShift,
  kCoulombCutoff2,
  kCoefficients
};

/// The cluster J of an entry, beside the cluster I of its row. Unless kShifts, the shift was taken from I.
template <class S, bool kShifts = true>
struct OneBeside {
  using V = typename S::V;
  using Real = typename S::Real;
  std::int32_t cluster() const { return entry->cluster; }
  std::uint32_t mask() const { return entry->mask; }
  auto places(const LjTask<Real>& task, const ClusterPairs::Row& row) const {
    if constexpr (kShifts)
      return S::load_cluster(task.at[entry->cluster], task.shift[row.first_shift + entry->shift]);
    else
      return S::load_cluster(task.at[entry->cluster]);
  }
  V repeat(const Real* by_slot) const { return S::repeat(by_slot + 4 * entry->cluster); }
  auto columns(const std::int32_t* by_slot) const { return S::columns(by_slot + 4 * entry->cluster); }
  void add(V force, const Coordinates<S>& d, Real* lanes) const {
    Real* const to = lanes + kNumbersOfLanes * entry->cluster;
    S::store(to, S::madd(force, d.x[0], S::load(to)));
    S::store(to + 16, S::madd(force, d.y[0], S::load(to + 16)));
    S::store(to + 32, S::madd(force, d.z[0], S::load(to + 32)));
  }
  void tally(V of_i, int n, double* tallies) const {
    S::tally_over_i(of_i, tallies + kTalliedOfCluster * entry->cluster + 4 * n);
  }

  const ClusterPairs::Entry* entry;
};

/// Two clusters J, of an entry and of the next one, each with the pairs that the other one has none at. The
/// shift was taken from cluster I.
template <class S>
struct TwoBeside {
  using V = typename S::V;
  using Real = typename S::Real;
  std::uint32_t of_second() const { return entry[1].mask; }
  std::uint32_t mask() const { return static_cast<std::uint32_t>(entry[0].mask | entry[1].mask); }
  auto places(const LjTask<Real>& task, const ClusterPairs::Row&) const {
    return S::load_clusters(task.at[entry[0].cluster], of_second(), task.at[entry[1].cluster]);
  }
  V repeat(const Real* by_slot) const {
    return S::repeat_either(by_slot + 4 * entry[0].cluster, of_second(), by_slot + 4 * entry[1].cluster);
  }
  auto columns(const std::int32_t* by_slot) const {
    return S::repeat_either(by_slot + 4 * entry[0].cluster, of_second(), by_slot + 4 * entry[1].cluster);
  }
  void add(V force, const Coordinates<S>& d, Real* lanes) const {
    Real* const first = lanes + kNumbersOfLanes * entry[0].cluster;
    Real* const second = lanes + kNumbersOfLanes * entry[1].cluster;
    S::add_either(force, d.x[0], first, of_second(), second);
    S::add_either(force, d.y[0], first + 16, of_second(), second + 16);
    S::add_either(force, d.z[0], first + 32, of_second(), second + 32);
  }
  void tally(V of_i, int n, double* tallies) const {
    S::tally_either(of_i, tallies + kTalliedOfCluster * entry[0].cluster + 4 * n, of_second(),
                    tallies + kTalliedOfCluster * entry[1].cluster + 4 * n);
  }

  const ClusterPairs::Entry* entry;
};

/// The coefficients of 16 pairs, register by register; those of one type are the same for all.
template <class S, LjParameters kParameters>
struct PairCoefficients;

template <class S>
struct PairCoefficients<S, LjParameters::one_type> {
  static constexpr bool kMixes = false;
  using V = typename S::V;
  using Real = typename S::Real;
  explicit PairCoefficients(const LjTask<Real>& task) : PairCoefficients(task.coefficients) {}
  explicit PairCoefficients(const LjCoefficients<Real>& c) {
    const Real* const from[kCoefficients] = {c.cutoff2, c.force12,      c.force6,         c.energy12,
                                             c.energy6, c.energy_shift, c.coulomb_cutoff2};
    for (int k = 0; k < kCoefficients; ++k) value[k] = S::set1(*from[k]);
  }
  void choose_i(std::int32_t) {}
  template <class J>
  void choose_j(const J&) {}
  V operator()(int k, int) const { return value[k]; }
  V common_cutoff2() const { return value[kCutoff2]; }

  V value[kCoefficients];
};

template <class S>
struct PairCoefficients<S, LjParameters::by_type> {
  static constexpr bool kMixes = false;
  using V = typename S::V;
  using Real = typename S::Real;
  explicit PairCoefficients(const LjTask<Real>& task)
      : type(task.type),
        types(task.types),
        c(task.coefficients),
        table{c.cutoff2, c.force12, c.force6, c.energy12, c.energy6, c.energy_shift, c.coulomb_cutoff2},
        cutoff2(S::set1(*c.cutoff2)) {}
  void choose_i(std::int32_t cluster) {
    for (int a = 0; a < 4; ++a) row[a] = type[4 * cluster + a] * types;
  }
  template <class J>
  void choose_j(const J& beside) {
    of_j = beside.columns(type);
  }
  V operator()(int k, int which) const { return S::lookup(table[k], types, row, of_j, which); }
  V common_cutoff2() const { return cutoff2; }

  const std::int32_t* type;
  std::int32_t types;
  LjCoefficients<Real> c;
  const Real* table[kCoefficients];
  V cutoff2;
  std::int32_t row[4]{};
  typename S::Columns of_j{};
};

/// Mixed by the rules of Lorentz and Berthelot: mean sigma, geometric mean of epsilon. The same cutoffs for
/// all.
template <class S>
struct PairCoefficients<S, LjParameters::by_particle> {
  static constexpr bool kMixes = true;
  using V = typename S::V;
  using Real = typename S::Real;
  explicit PairCoefficients(const LjTask<Real>& task)
      : half_sigma(task.half_sigma),
        root_epsilon(task.root_epsilon),
        cutoff2(S::set1(*task.coefficients.cutoff2)),
        coulomb_cutoff2(S::set1(*task.coefficients.coulomb_cutoff2)) {}
  void choose_i(std::int32_t cluster) {
    for (int p = 0; p < S::kRegisters; ++p) {
      sigma_of_i[p] = S::spread(half_sigma + 4 * cluster, p);
      epsilon_of_i[p] = S::spread(root_epsilon + 4 * cluster, p);
    }
  }
  template <class J>
  void choose_j(const J& beside) {
    sigma_of_j = beside.repeat(half_sigma);
    epsilon_of_j = beside.repeat(root_epsilon);
  }
  V operator()(int k, int) const { return k == kCoulombCutoff2 ? coulomb_cutoff2 : cutoff2; }
  V common_cutoff2() const { return S::max(cutoff2, coulomb_cutoff2); }
  V sigma(int p) const { return S::add(sigma_of_i[p], sigma_of_j); }
  V four_epsilon(int p) const { return S::mul(epsilon_of_i[p], epsilon_of_j); }

  const Real *half_sigma, *root_epsilon;
  V cutoff2, coulomb_cutoff2, sigma_of_i[S::kRegisters], epsilon_of_i[S::kRegisters], sigma_of_j,
      epsilon_of_j;
};

}  // namespace
}  // namespace dch::detail
