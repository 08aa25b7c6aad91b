// SPDX-License-Identifier: MIT
//
// The Lennard-Jones loops over vector types; see cluster_kernels_loops.hpp.
#pragma once

#include "cluster_kernels_loops.hpp"

namespace dch::detail {
namespace {

/// The coefficients of 16 pairs, part by part; those of one type are the same for all.
template <class S, bool kOneType>
struct PairCoefficients;

template <class S>
struct PairCoefficients<S, true> {
  using V = typename S::V;
  using Real = typename S::Real;
  explicit PairCoefficients(const LjTask<Real>& task) {
    const LjCoefficients<Real>& c = task.coefficients;
    const Real* const from[6] = {c.cutoff2, c.force12, c.force6, c.energy12, c.energy6, c.energy_shift};
    for (int k = 0; k < 6; ++k) value[k] = S::set1(*from[k]);
  }
  void choose_i(std::int32_t) {}
  void choose_j(std::int32_t) {}
  V operator()(int k, int) const { return value[k]; }

  V value[6];
};

template <class S>
struct PairCoefficients<S, false> {
  using V = typename S::V;
  using Real = typename S::Real;
  explicit PairCoefficients(const LjTask<Real>& task)
      : type(task.type), types(task.types), c(task.coefficients),
        table{c.cutoff2, c.force12, c.force6, c.energy12, c.energy6, c.energy_shift} {}
  void choose_i(std::int32_t cluster) {
    for (int a = 0; a < 4; ++a) row[a] = type[4 * cluster + a] * types;
  }
  void choose_j(std::int32_t cluster) { of_j = type + 4 * cluster; }
  V operator()(int k, int part) const { return S::lookup(table[k], row, of_j, part); }

  const std::int32_t* type;
  std::int32_t types;
  LjCoefficients<Real> c;
  const Real* table[6];
  std::int32_t row[4]{};
  const std::int32_t* of_j = nullptr;
};

enum Coefficient { kCutoff2, kForce12, kForce6, kEnergy12, kEnergy6, kEnergyShift };

template <class S, bool kOneType, bool kSums>
void lennard_jones(const LjTask<typename S::Real>& task, LjSums& sums) {
  using V = typename S::V;
  PairCoefficients<S, kOneType> coefficient(task);
  for (std::int64_t r = 0; r < task.row_count; ++r) {
    const ClusterPairs::Row row = task.rows[r];
    const ClusterOfFour<typename S::Real>& own = task.at[row.cluster];
    const Coordinates<S> i = spread<S>(own);
    const ClusterShift<typename S::Real>* const shift = task.shift + row.first_shift;
    coefficient.choose_i(row.cluster);
    Coordinates<S> force_i;
    V energy = S::zero(), virial[6];
    for (int p = 0; p < S::kParts; ++p) force_i.x[p] = force_i.y[p] = force_i.z[p] = S::zero();
    for (V& v : virial) v = S::zero();
    const std::int64_t end = task.rows[r + 1].first;
    for (std::int64_t e = row.first; e < end; ++e) {
      const ClusterPairs::Entry entry = task.entries[e];
      const auto j = S::load_cluster(task.at[entry.cluster], shift[entry.shift], own);
      coefficient.choose_j(entry.cluster);
      Coordinates<S> force;
      for (int p = 0; p < S::kParts; ++p) {
        const V dx = S::sub(j.x, i.x[p]), dy = S::sub(j.y, i.y[p]), dz = S::sub(j.z, i.z[p]);
        const V r2 = S::madd(dx, dx, S::madd(dy, dy, S::mul(dz, dz)));
        const auto within = S::less(r2, coefficient(kCutoff2, p), entry.mask, p);
        const V s = S::keep(within, S::inverse(r2));  // 0 for other lanes, whatever stands there
        const V s3 = S::mul(S::mul(s, s), s);
        const V f =
            S::mul(S::mul(s3, s), S::msub(coefficient(kForce12, p), s3, coefficient(kForce6, p)));
        force.x[p] = S::mul(f, dx);
        force.y[p] = S::mul(f, dy);
        force.z[p] = S::mul(f, dz);
        force_i.x[p] = S::add(force_i.x[p], force.x[p]);
        force_i.y[p] = S::add(force_i.y[p], force.y[p]);
        force_i.z[p] = S::add(force_i.z[p], force.z[p]);
        if constexpr (kSums) {
          const V above = S::keep(within, coefficient(kEnergyShift, p));
          const V bound = S::msub(coefficient(kEnergy12, p), s3, coefficient(kEnergy6, p));
          energy = S::add(energy, S::msub(s3, bound, above));
          virial[0] = S::madd(dx, force.x[p], virial[0]);
          virial[1] = S::madd(dy, force.y[p], virial[1]);
          virial[2] = S::madd(dz, force.z[p], virial[2]);
          virial[3] = S::madd(dx, force.y[p], virial[3]);
          virial[4] = S::madd(dx, force.z[p], virial[4]);
          virial[5] = S::madd(dy, force.z[p], virial[5]);
        }
      }
      S::add_over_i(force, task.force[entry.cluster]);
    }
    S::subtract_over_j(force_i, task.force[row.cluster]);
    if constexpr (kSums) {
      sums.energy += S::sum(energy);
      for (int k = 0; k < 6; ++k) sums.virial[k] += S::sum(virial[k]);
    }
  }
}

template <class S>
constexpr LjFunctions<typename S::Real> lj_functions_of{
    lennard_jones<S, true, false>, lennard_jones<S, true, true>, lennard_jones<S, false, false>,
    lennard_jones<S, false, true>};

}  // namespace
}  // namespace dch::detail
