// SPDX-License-Identifier: MIT
//
// The Lennard-Jones loops over vector types; see cluster_kernels_loops.hpp.
#pragma once

#include "cluster_kernels_loops.hpp"

namespace dch::detail {
namespace {

enum Coefficient { kCutoff2, kForce12, kForce6, kEnergy12, kEnergy6, kEnergyShift };

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
      : type(task.type), types(task.types), c(task.coefficients), table{c.cutoff2, c.force12,
                                                                        c.force6,  c.energy12,
                                                                        c.energy6, c.energy_shift} {}
  void choose_i(std::int32_t cluster) {
    for (int a = 0; a < 4; ++a) row[a] = type[4 * cluster + a] * types;
  }
  void choose_j(std::int32_t cluster) { of_j = type + 4 * cluster; }
  V operator()(int k, int part) const { return S::lookup(table[k], types, row, of_j, part); }

  const std::int32_t* type;
  std::int32_t types;
  LjCoefficients<Real> c;
  const Real* table[6];
  std::int32_t row[4]{};
  const std::int32_t* of_j = nullptr;
};

/// Displacements and inverse squared distances of an entry's pairs; the latter are 0 where nothing acts.
template <class S>
struct Separations {
  Coordinates<S> d;
  typename S::V s[S::kParts];
};

template <class S, bool kOneType>
Separations<S> measure(const LjTask<typename S::Real>& task, const ClusterPairs::Row& row,
                       const Coordinates<S>& i, const ClusterPairs::Entry& entry,
                       PairCoefficients<S, kOneType>& coefficient) {
  using V = typename S::V;
  const auto j = S::load_cluster(task.at[entry.cluster], task.shift[row.first_shift + entry.shift],
                                 task.at[row.cluster]);
  coefficient.choose_j(entry.cluster);
  Separations<S> found;
  for (int p = 0; p < S::kParts; ++p) {
    const V dx = S::sub(j.x, i.x[p]), dy = S::sub(j.y, i.y[p]), dz = S::sub(j.z, i.z[p]);
    const V r2 = S::madd(dx, dx, S::madd(dy, dy, S::mul(dz, dz)));
    found.d.x[p] = dx;
    found.d.y[p] = dy;
    found.d.z[p] = dz;
    found.s[p] = S::keep(S::less(r2, coefficient(kCutoff2, p), entry.mask, p), S::inverse(r2));
  }
  return found;
}

template <class S>
struct RowSums {
  Coordinates<S> force;
  typename S::V energy, virial[6];
};

/// Adds the forces of an entry to those of its cluster J, and to what the row has summed up.
template <class S, bool kOneType, bool kSums>
void apply(const LjTask<typename S::Real>& task, const ClusterPairs::Entry& entry,
           const Separations<S>& separation, PairCoefficients<S, kOneType>& coefficient, RowSums<S>& sum) {
  using V = typename S::V;
  coefficient.choose_j(entry.cluster);
  Coordinates<S> force;
  for (int p = 0; p < S::kParts; ++p) {
    const V dx = separation.d.x[p], dy = separation.d.y[p], dz = separation.d.z[p], s = separation.s[p];
    const V s3 = S::mul(S::mul(s, s), s);
    const V f = S::mul(S::mul(s3, s), S::msub(coefficient(kForce12, p), s3, coefficient(kForce6, p)));
    force.x[p] = S::mul(f, dx);
    force.y[p] = S::mul(f, dy);
    force.z[p] = S::mul(f, dz);
    sum.force.x[p] = S::add(sum.force.x[p], force.x[p]);
    sum.force.y[p] = S::add(sum.force.y[p], force.y[p]);
    sum.force.z[p] = S::add(sum.force.z[p], force.z[p]);
    if constexpr (kSums) {
      const V bound = S::msub(coefficient(kEnergy12, p), s3, coefficient(kEnergy6, p));
      const V above = S::keep(S::less(S::zero(), s, 0xFFFF, p), coefficient(kEnergyShift, p));
      sum.energy = S::add(sum.energy, S::msub(s3, bound, above));
      sum.virial[0] = S::madd(dx, force.x[p], sum.virial[0]);
      sum.virial[1] = S::madd(dy, force.y[p], sum.virial[1]);
      sum.virial[2] = S::madd(dz, force.z[p], sum.virial[2]);
      sum.virial[3] = S::madd(dx, force.y[p], sum.virial[3]);
      sum.virial[4] = S::madd(dx, force.z[p], sum.virial[4]);
      sum.virial[5] = S::madd(dy, force.z[p], sum.virial[5]);
    }
  }
  S::add_over_i(force, task.force[entry.cluster]);
}

/// Separations are measured one entry ahead: the chain of dependent operations through one entry is longer
/// than what a processor can look ahead over.
template <class S, bool kOneType, bool kSums>
void lennard_jones(const LjTask<typename S::Real>& task, LjSums& sums) {
  PairCoefficients<S, kOneType> coefficient(task);
  for (std::int64_t r = 0; r < task.row_count; ++r) {
    const ClusterPairs::Row row = task.rows[r];
    const Coordinates<S> i = spread<S>(task.at[row.cluster]);
    coefficient.choose_i(row.cluster);
    RowSums<S> sum;
    for (int p = 0; p < S::kParts; ++p) sum.force.x[p] = sum.force.y[p] = sum.force.z[p] = S::zero();
    sum.energy = S::zero();
    for (auto& v : sum.virial) v = S::zero();
    const ClusterPairs::Entry* entry = task.entries + row.first;
    const ClusterPairs::Entry* const last = task.entries + task.rows[r + 1].first - 1;
    Separations<S> separation = measure<S>(task, row, i, *entry, coefficient);
    for (; entry != last; ++entry) {
      const Separations<S> next = measure<S>(task, row, i, entry[1], coefficient);
      apply<S, kOneType, kSums>(task, *entry, separation, coefficient, sum);
      separation = next;
    }
    apply<S, kOneType, kSums>(task, *entry, separation, coefficient, sum);
    S::subtract_over_j(sum.force, task.force[row.cluster]);
    if constexpr (kSums) {
      sums.energy += S::sum(sum.energy);
      for (int k = 0; k < 6; ++k) sums.virial[k] += S::sum(sum.virial[k]);
    }
  }
}

template <class S>
constexpr LjFunctions<typename S::Real> lj_functions_of{
    lennard_jones<S, true, false>, lennard_jones<S, true, true>, lennard_jones<S, false, false>,
    lennard_jones<S, false, true>};

}  // namespace
}  // namespace dch::detail
