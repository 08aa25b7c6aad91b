// SPDX-License-Identifier: MIT
//
// The loops over pairs one by one where particles have many neighbors: row by row; see cluster_loops.hpp.
#pragma once

#include <algorithm>

#include "simd/lj_pair_kernels_loops.hpp"

namespace dch::detail {
namespace {

/// The coefficients of one pair of types in all lanes.
template <class S>
struct SameCoefficients {
  static constexpr bool kMixes = false;
  typename S::V operator()(int k, int) const { return S::set1(table[k][at]); }

  const double* const* table;
  std::int32_t at;
};

/// Pairs of one particle i, those of `mask`.
template <class S>
struct RowPairs {
  const std::int32_t *i, *j;
  std::uint32_t mask;
};

/// Adds forces to the second particles one after the other, and the opposite of their sum to i.
template <class S>
void add_to_row(std::uint32_t lanes, const RowPairs<S>& pairs, typename S::V fx, typename S::V fy,
                typename S::V fz, Vec3* forces) {
  alignas(64) double x[S::kLanes], y[S::kLanes], z[S::kLanes];
  S::store(x, fx);
  S::store(y, fy);
  S::store(z, fz);
  Vec3& of_i = forces[*pairs.i];
  of_i.x -= S::sum(fx);
  of_i.y -= S::sum(fy);
  of_i.z -= S::sum(fz);
  for (; lanes != 0; lanes &= lanes - 1) {
    const int k = __builtin_ctz(lanes);
    Vec3& of_j = forces[pairs.j[k]];
    of_j.x += x[k];
    of_j.y += y[k];
    of_j.z += z[k];
  }
}

template <class S, Wanted kFound, class Kind, class Coefficients>
void add_near_of_row(const LjPairTask& task, const RowPairs<S>& pairs, const typename S::V (&d)[3],
                     const Constants<S>& constants, const Coefficients& coefficient, LaneSums<S>& sum) {
  using V = typename S::V;
  const V r2 = S::madd(d[0], d[0], S::madd(d[1], d[1], S::mul(d[2], d[2])));
  const auto near = S::less(r2, coefficient(kCutoff2, 0), pairs.mask, 0);
  const std::uint32_t lanes = S::bits(near);
  if (lanes == 0) return;
  constexpr bool kSums = kFound != Wanted::forces;
  const PairTerms<S> terms = Kind::template terms<S, kSums>(coefficient, 0, r2, S::keep(near, S::inverse(r2)),
                                                            {S::zero(), S::zero()}, constants);
  const V f[3] = {S::mul(terms.force, d[0]), S::mul(terms.force, d[1]), S::mul(terms.force, d[2])};
  if constexpr (kSums) {
    sum.energy = S::add(sum.energy, terms.energy);
    const V of_pairs[6] = {S::mul(d[0], f[0]), S::mul(d[1], f[1]), S::mul(d[2], f[2]),
                           S::mul(d[0], f[1]), S::mul(d[0], f[2]), S::mul(d[1], f[2])};
    for (int k = 0; k < 6; ++k) sum.virial[k] = S::add(sum.virial[k], of_pairs[k]);
    if constexpr (kFound == Wanted::tallies) {
      const V tallied[kTallied] = {terms.energy, S::zero(),   of_pairs[0], of_pairs[1],
                                   of_pairs[2],  of_pairs[3], of_pairs[4], of_pairs[5]};
      add_halves_to_both<S>(lanes, pairs.i, pairs.j, tallied, task.tallies);
    }
  }
  add_to_row<S>(lanes, pairs, f[0], f[1], f[2], task.forces);
}

/// As many of kLanes pairs as are of the first one's particle i, those there are. Where all are of one pair
/// of types, as in a solvent, coefficients are loaded once, not lane by lane.
/// @param there  bits of the pairs that there are, from the first one on
/// @returns how many
template <class S, Wanted kFound, class Kind>
int add_row(const LjPairTask& task, const std::int32_t* i, const std::int32_t* j, std::uint32_t there,
            const Coordinates<S>& shift, const Constants<S>& constants,
            LaneCoefficients<S, LjParameters::by_type>& coefficient, LaneSums<S>& sum) {
  using V = typename S::V;
  const std::int32_t own = *i, row = task.type[own] * task.types;
  std::uint32_t others = 0, of_other_types = 0;
  for (int k = 0; k < S::kLanes; ++k) others |= i[k] != own ? 1u << k : 0u;
  for (int k = 0; k < S::kLanes; ++k) coefficient.at[k] = row + task.type[j[k]];
  for (int k = 0; k < S::kLanes; ++k) of_other_types |= coefficient.at[k] != coefficient.at[0] ? 1u << k : 0u;
  const int count = __builtin_ctz(others | ~there);
  const RowPairs<S> pairs{i, j, (1u << count) - 1};
  const Vec3 at = task.positions[own];
  V x, y, z;
  S::gather_xyz(&task.positions->x, j, x, y, z);
  const V d[3] = {S::add(S::sub(x, S::set1(at.x)), shift.x[0]), S::add(S::sub(y, S::set1(at.y)), shift.y[0]),
                  S::add(S::sub(z, S::set1(at.z)), shift.z[0])};
  if ((of_other_types & pairs.mask) == 0)
    add_near_of_row<S, kFound, Kind>(task, pairs, d, constants,
                                     SameCoefficients<S>{coefficient.table, coefficient.at[0]}, sum);
  else
    add_near_of_row<S, kFound, Kind>(task, pairs, d, constants, coefficient, sum);
  return count;
}

/// How many pairs before they are computed the second particles of kAhead pairs come into the cache. Most are
/// there; in systems of a million particles every tenth is not.
inline constexpr int kAhead = 16;

inline void fetch_second(const LjPairTask& task, std::int64_t k) {
  for (int lane = 0; lane < kAhead / 2; ++lane) {
    const std::int32_t j = task.j[k + lane];
    __builtin_prefetch(&task.positions[j]);
    __builtin_prefetch(&task.forces[j], 1);
  }
}

/// As lennard_jones_of_pairs, of forms without charges. Rows need not be whole: pairs next to each other are
/// computed at once if they have the same i.
template <class S, Wanted kFound, class Kind>
DCH_FLATTEN void rows_of_pairs(const LjPairTask& task, LjSums& sums) {
  static_assert(!Kind::kHasCharges && !Kind::kActsAtZero);
  LaneCoefficients<S, LjParameters::by_type> coefficient(task.coefficients);
  const Constants<S> constants(task.constants);
  const Coordinates<S> shift = shift_of<S>(task);
  LaneSums<S> sum;
  constexpr std::uint32_t kAll = (1u << S::kLanes) - 1;
  std::int64_t k = task.first;
  while (k + S::kLanes <= task.last) {
    if (k + 2 * kAhead <= task.last) fetch_second(task, k + kAhead);
    k += add_row<S, kFound, Kind>(task, task.i + k, task.j + k, kAll, shift, constants, coefficient, sum);
  }
  while (k < task.last) {
    // Lanes without a pair repeat the first one.
    std::int32_t i[S::kLanes], j[S::kLanes];
    const auto left = static_cast<int>(task.last - k);
    for (int lane = 0; lane < S::kLanes; ++lane) {
      i[lane] = task.i[lane < left ? k + lane : k];
      j[lane] = task.j[lane < left ? k + lane : k];
    }
    k += add_row<S, kFound, Kind>(task, i, j, (1u << left) - 1, shift, constants, coefficient, sum);
  }
  sum.template give<kFound, Kind>(sums);
}

}  // namespace
}  // namespace dch::detail
