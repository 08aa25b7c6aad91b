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
  void choose_j(std::int32_t) {}
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
  void choose_j(std::int32_t cluster) { of_j = type + 4 * cluster; }
  V operator()(int k, int which) const { return S::lookup(table[k], types, row, of_j, which); }
  V common_cutoff2() const { return cutoff2; }

  const std::int32_t* type;
  std::int32_t types;
  LjCoefficients<Real> c;
  const Real* table[kCoefficients];
  V cutoff2;
  std::int32_t row[4]{};
  const std::int32_t* of_j = nullptr;
};

/// Mixed by the rules of Lorentz and Berthelot: mean sigma, geometric mean of epsilon. One cutoff for all.
template <class S>
struct PairCoefficients<S, LjParameters::by_particle> {
  static constexpr bool kMixes = true;
  using V = typename S::V;
  using Real = typename S::Real;
  explicit PairCoefficients(const LjTask<Real>& task)
      : half_sigma(task.half_sigma),
        root_epsilon(task.root_epsilon),
        cutoff2(S::set1(*task.coefficients.cutoff2)) {}
  void choose_i(std::int32_t cluster) {
    for (int p = 0; p < S::kRegisters; ++p) {
      sigma_of_i[p] = S::spread(half_sigma + 4 * cluster, p);
      epsilon_of_i[p] = S::spread(root_epsilon + 4 * cluster, p);
    }
  }
  void choose_j(std::int32_t cluster) { of_j = 4 * cluster; }
  V operator()(int, int) const { return cutoff2; }
  V common_cutoff2() const { return cutoff2; }
  V sigma(int p) const { return S::add(sigma_of_i[p], S::repeat(half_sigma + of_j)); }
  V four_epsilon(int p) const { return S::mul(epsilon_of_i[p], S::repeat(root_epsilon + of_j)); }

  const Real *half_sigma, *root_epsilon;
  V cutoff2, sigma_of_i[S::kRegisters], epsilon_of_i[S::kRegisters];
  std::int32_t of_j = 0;
};

}  // namespace
}  // namespace dch::detail
