// SPDX-License-Identifier: MIT
//
// The three passes of a generalized Born sum over cluster pairs, over vector types; see cluster_loops.hpp.
#pragma once

#include "simd/born_numbers_loops.hpp"
#include "simd/born_terms_loops.hpp"

namespace dch::detail {
namespace {

/// What necks of the pairs of a register read.
template <class S>
struct Necks {
  using V = typename S::V;
  void choose_i(const BornTask& task, std::int32_t cluster) {
    for (int a = 0; a < 4; ++a) row[a] = task.kind[4 * cluster + a] * task.kinds;
  }
  void choose_j(const BornTask& task, std::int32_t cluster) { column = task.kind + 4 * cluster; }
  NeckTerms<S> of_i(const BornTask& task, const Distance<S>& d, int p) const {
    return {d, look_up(task, task.neck_at, p), look_up(task, task.neck_height, p)};
  }
  NeckTerms<S> of_j(const BornTask& task, const Distance<S>& d, int p) const {
    return {d, look_up(task, task.neck_at_of_j, p), look_up(task, task.neck_height_of_j, p)};
  }
  V look_up(const BornTask& task, const float* table, int p) const {
    return S::lookup(table, task.kinds, row, S::columns(column), p);
  }
  std::int32_t row[4]{};
  const std::int32_t* column = nullptr;
};

/// The integrals I: of each particle the sum of H over the others, and of their necks.
template <class S, bool kNecks>
struct IntegralPass {
  using V = typename S::V;
  static constexpr bool kForces = false, kScalars = true;

  explicit IntegralPass(const BornTask& of) : task(of) {}
  void begin(std::int32_t cluster) {
    for (int p = 0; p < S::kRegisters; ++p) {
      radius_i[p] = S::spread(task.radius + 4 * cluster, p);
      scaled_i[p] = S::spread(task.scaled + 4 * cluster, p);
    }
    if constexpr (kNecks) necks.choose_i(task, cluster);
  }
  void act(const ClusterPairs::Entry& entry, const BornApart<S>& apart, BornNumbers<S>& row) {
    BornNumbers<S> of_j;
    if constexpr (kNecks) necks.choose_j(task, entry.cluster);
    const V radius_j = S::repeat(task.radius + 4 * entry.cluster);
    const V scaled_j = S::repeat(task.scaled + 4 * entry.cluster);
    for (int p = 0; p < S::kRegisters; ++p) {
      const V r2 = apart.r2[p];
      V of_i;
      if (any_within<S>(r2, task.constants.far2, entry.mask, p)) {
        const auto acts = S::less(r2, S::set1(task.constants.cutoff2), entry.mask, p);
        const Distance<S> d(r2);
        const V inside = S::set1(task.constants.counts_inside);
        of_i = S::keep(acts, NearTerms<S>(d, radius_i[p], scaled_j).integral(inside, entry.mask, p));
        of_j.scalar[p] =
            S::keep(acts, NearTerms<S>(d, radius_j, scaled_i[p]).integral(inside, entry.mask, p));
      } else {
        const V s = S::keep(S::less(r2, S::set1(task.constants.cutoff2), entry.mask, p), S::inverse(r2));
        of_i = far_integral<S>(s, scaled_j);
        of_j.scalar[p] = far_integral<S>(s, scaled_i[p]);
      }
      if constexpr (kNecks) add_necks(entry, r2, S::add(radius_i[p], radius_j), p, of_i, of_j.scalar[p]);
      row.scalar[p] = S::sub(row.scalar[p], of_i);  // what a row has summed up is subtracted
    }
    give_to_j<S, kForces, kScalars>(task, entry.cluster, of_j);
  }
  void add_necks(const ClusterPairs::Entry& entry, V r2, V radii, int p, V& of_i, V& of_j) const {
    if (!any_within<S>(r2, task.constants.neck_far2, entry.mask, p)) return;
    const Distance<S> d(r2);
    const V near = S::keep(S::less(r2, S::set1(task.constants.cutoff2), entry.mask, p),
                           S::add(radii, S::set1(task.constants.neck_reach)));
    const auto acts = S::less(d.r, near, entry.mask, p);
    const V scale = S::set1(task.constants.neck_scale);
    // What is not kept may be no number: far away the denominators overflow.
    of_i = S::madd(scale, S::keep(acts, necks.of_i(task, d, p).value), of_i);
    of_j = S::madd(scale, S::keep(acts, necks.of_j(task, d, p).value), of_j);
  }

  const BornTask& task;
  V radius_i[S::kRegisters], scaled_i[S::kRegisters];
  Necks<S> necks;
};

/// Energies of pairs, forces at constant Born radii, and -dE/dB times the Born radius.
template <class S, bool kEnergy, bool kSalt>
struct EnergyPass {
  using V = typename S::V;
  static constexpr bool kForces = true, kScalars = true;

  explicit EnergyPass(const BornTask& of) : task(of), sum(S::zero()) {}
  void begin(std::int32_t cluster) {
    total -= S::sum(sum);
    sum = S::zero();
    for (int p = 0; p < S::kRegisters; ++p) {
      charge_i[p] = S::mul(S::spread(task.charge + 4 * cluster, p), S::set1(task.constants.factor));
      born_i[p] = S::spread(task.born + 4 * cluster, p);
      half_over_i[p] = S::spread(task.half_over + 4 * cluster, p);
    }
  }
  void act(const ClusterPairs::Entry& entry, const BornApart<S>& apart, BornNumbers<S>& row) {
    BornNumbers<S> of_j;
    const V charge_j = S::repeat(task.charge + 4 * entry.cluster);
    const V born_j = S::repeat(task.born + 4 * entry.cluster);
    const V half_over_j = S::repeat(task.half_over + 4 * entry.cluster);
    for (int p = 0; p < S::kRegisters; ++p) {
      const V r2 = apart.r2[p];
      const auto acts = S::less(r2, S::set1(task.constants.cutoff2), entry.mask, p);
      const V charges = S::keep(acts, S::mul(charge_i[p], charge_j));
      const BornPairTerms<S> terms = born_pair_terms<S, kEnergy, kSalt>(
          r2, charges, S::mul(born_i[p], born_j), S::mul(half_over_i[p], half_over_j), task.constants);
      add_born_force<S>(terms.force, apart.d, p, of_j, row);
      of_j.scalar[p] = terms.slope;
      row.scalar[p] = S::sub(row.scalar[p], terms.slope);
      if constexpr (kEnergy) sum = S::add(sum, terms.energy);
    }
    give_to_j<S, kForces, kScalars>(task, entry.cluster, of_j);
  }

  const BornTask& task;
  V sum, charge_i[S::kRegisters], born_i[S::kRegisters], half_over_i[S::kRegisters];
  double total = 0;
};

/// Forces by the chain rule: -dE/dI dI/dr.
template <class S, bool kNecks>
struct ChainPass {
  using V = typename S::V;
  static constexpr bool kForces = true, kScalars = false;

  explicit ChainPass(const BornTask& of) : task(of) {}
  void begin(std::int32_t cluster) {
    for (int p = 0; p < S::kRegisters; ++p) {
      radius_i[p] = S::spread(task.radius + 4 * cluster, p);
      scaled_i[p] = S::spread(task.scaled + 4 * cluster, p);
      slope_i[p] = S::spread(task.slope + 4 * cluster, p);
    }
    if constexpr (kNecks) necks.choose_i(task, cluster);
  }
  void act(const ClusterPairs::Entry& entry, const BornApart<S>& apart, BornNumbers<S>& row) {
    BornNumbers<S> of_j;
    if constexpr (kNecks) necks.choose_j(task, entry.cluster);
    const V radius_j = S::repeat(task.radius + 4 * entry.cluster);
    const V scaled_j = S::repeat(task.scaled + 4 * entry.cluster);
    const V slope_j = S::repeat(task.slope + 4 * entry.cluster);
    for (int p = 0; p < S::kRegisters; ++p) {
      const V r2 = apart.r2[p];
      V force;
      if (any_within<S>(r2, task.constants.far2, entry.mask, p)) {
        const Distance<S> d(r2);
        const V inside = S::set1(task.constants.counts_inside);
        const V of_i = NearTerms<S>(d, radius_i[p], scaled_j).slope(inside, entry.mask, p);
        const V of_its = NearTerms<S>(d, radius_j, scaled_i[p]).slope(inside, entry.mask, p);
        force = S::keep(S::less(r2, S::set1(task.constants.cutoff2), entry.mask, p),
                        S::madd(slope_i[p], of_i, S::mul(slope_j, of_its)));
      } else {
        const V s = S::keep(S::less(r2, S::set1(task.constants.cutoff2), entry.mask, p), S::inverse(r2));
        force = S::madd(slope_i[p], far_slope<S>(s, scaled_j), S::mul(slope_j, far_slope<S>(s, scaled_i[p])));
      }
      if constexpr (kNecks) add_necks(entry, r2, S::add(radius_i[p], radius_j), slope_j, p, force);
      add_born_force<S>(force, apart.d, p, of_j, row);
    }
    give_to_j<S, kForces, kScalars>(task, entry.cluster, of_j);
  }
  void add_necks(const ClusterPairs::Entry& entry, V r2, V radii, V slope_j, int p, V& force) const {
    if (!any_within<S>(r2, task.constants.neck_far2, entry.mask, p)) return;
    const Distance<S> d(r2);
    const V near = S::keep(S::less(r2, S::set1(task.constants.cutoff2), entry.mask, p),
                           S::add(radii, S::set1(task.constants.neck_reach)));
    const V sum =
        S::madd(slope_i[p], necks.of_i(task, d, p).slope, S::mul(slope_j, necks.of_j(task, d, p).slope));
    force =
        S::madd(S::set1(task.constants.neck_scale), S::keep(S::less(d.r, near, entry.mask, p), sum), force);
  }

  const BornTask& task;
  V radius_i[S::kRegisters], scaled_i[S::kRegisters], slope_i[S::kRegisters];
  Necks<S> necks;
};

template <class S, class Pass>
DCH_FLATTEN void run_pass(const BornTask& task, Pass& pass) {
  const typename S::V unit2 = S::set1(static_cast<typename S::Real>(task.unit * task.unit));
  for (std::int64_t r = 0; r < task.row_count; ++r) {
    const ClusterPairs::Row row = task.rows[r];
    const Places<S> i = spread<S>(task.at[row.cluster]);
    pass.begin(row.cluster);
    BornNumbers<S> sum;
    for (std::int64_t e = row.first; e < task.rows[r + 1].first; ++e)
      pass.act(task.entries[e], born_apart<S>(task, row, i, task.entries[e], unit2), sum);
    if constexpr (Pass::kForces) S::subtract_over_j(sum.force, task.force[row.cluster]);
    if constexpr (Pass::kScalars) S::subtract_over_j(as_coordinates<S>(sum.scalar), task.scalar[row.cluster]);
  }
  fold_born_lanes<S>(task, task.own);
  for (const ClusterPairs::Range& range : task.later) fold_born_lanes<S>(task, range);
}

template <class S, bool kNecks>
void born_integrals(const BornTask& task) {
  IntegralPass<S, kNecks> pass(task);
  run_pass<S>(task, pass);
}

template <class S, bool kEnergy, bool kSalt>
void born_energies(const BornTask& task, double& energy) {
  EnergyPass<S, kEnergy, kSalt> pass(task);
  run_pass<S>(task, pass);
  energy += pass.total - S::sum(pass.sum);
}

template <class S, bool kNecks>
void born_chain(const BornTask& task) {
  ChainPass<S, kNecks> pass(task);
  run_pass<S>(task, pass);
}

template <class S>
constexpr BornKernels born_kernels{{born_integrals<S, false>, born_integrals<S, true>},
                                   {{born_energies<S, false, false>, born_energies<S, false, true>},
                                    {born_energies<S, true, false>, born_energies<S, true, true>}},
                                   {born_chain<S, false>, born_chain<S, true>}};

}  // namespace
}  // namespace dch::detail
