// SPDX-License-Identifier: MIT
//
// Forces of all pairs over vector types; see cluster_loops.hpp. A lane is one particle j, beside one i.
//
// Coordinates are sums of two numbers in single precision. The difference of the first ones is exact to
// rounding, that of the second ones small: so distances are exact to rounding wherever the particles are.
#pragma once

#include "simd/all_pairs_task.hpp"
#include "simd/lj_kernels_loops.hpp"

namespace dch::detail {
namespace {

/// Particle i in all lanes, and what it sums up over a block.
template <class S>
struct OneOfAll {
  using V = typename S::V;
  OneOfAll(const AllPairsTask& task, std::int32_t i)
      : half_sigma(S::set1(task.half_sigma[i])),
        root_epsilon(S::set1(task.root_epsilon[i])),
        charge(S::set1(task.charge[i])) {
    for (int axis = 0; axis < 3; ++axis) {
      high[axis] = S::set1(task.high[axis][i]);
      low[axis] = S::set1(task.low[axis][i]);
      force[axis] = S::zero();
    }
  }
  V high[3], low[3], half_sigma, root_epsilon, charge, force[3];
  double energy = 0;
};

/// The pairs of i with the kLanes particles from j on, those of them that are in `mask`.
template <class S, bool kEnergy>
void act(const AllPairsTask& task, std::int32_t j, std::uint32_t mask, OneOfAll<S>& i) {
  using V = typename S::V;
  V d[3];
  for (int axis = 0; axis < 3; ++axis)
    d[axis] = S::add(S::sub(S::load(task.high[axis] + j), i.high[axis]),
                     S::sub(S::load(task.low[axis] + j), i.low[axis]));
  const V r2 = S::madd(d[0], d[0], S::madd(d[1], d[1], S::mul(d[2], d[2])));
  // So far apart that the square is no number: nothing acts.
  const V s = S::keep(S::less(r2, S::set1(3e38f), mask, 0), S::inverse(r2));
  const V coulomb = S::mul(S::mul(i.charge, S::load(task.charge + j)), S::over_root(r2, s));
  const V sigma = S::add(i.half_sigma, S::load(task.half_sigma + j)), t = S::mul(S::mul(sigma, sigma), s);
  const V t3 = S::mul(S::mul(t, t), t);
  const V attraction = S::mul(S::mul(i.root_epsilon, S::load(task.root_epsilon + j)), t3);
  const V force = S::mul(S::madd(attraction, S::madd(S::set1(12), t3, S::set1(-6)), coulomb), s);
  for (int axis = 0; axis < 3; ++axis) {
    i.force[axis] = S::madd(force, d[axis], i.force[axis]);
    float* const of_j = task.force[axis] + j;
    S::store(of_j, S::madd(force, d[axis], S::load(of_j)));
  }
  if constexpr (kEnergy) i.energy += S::sum(S::add(S::msub(attraction, t3, attraction), coulomb));
}

/// The lanes from j on whose particles come after i, exist, and are not excluded; moves on over the latter.
template <class S>
std::uint32_t lanes_of(const AllPairsTask& task, std::int32_t i, std::int32_t j) {
  std::uint32_t mask = 0xFFFF;
  if (j <= i) mask = mask << (i + 1 - j) & 0xFFFF;
  if (j + S::kLanes > task.count) mask &= (1u << (task.count - j)) - 1;
  const std::int32_t*& next = task.excluded[i - task.first];
  for (; next != task.excluded_end[i - task.first] && *next < j + S::kLanes; ++next)
    mask &= ~(1u << (*next - j));
  return mask;
}

template <class S, bool kEnergy>
DCH_FLATTEN void all_pairs(const AllPairsTask& task, double& energy) {
  const auto smaller_of = [](std::int32_t a, std::int32_t b) { return a < b ? a : b; };
  const std::int32_t end = smaller_of(task.first + kPairBlock, task.count);
  for (std::int32_t block = task.first; block < task.count; block += kPairBlock) {
    for (int axis = 0; axis < 3; ++axis)
      for (std::int32_t j = block; j < block + kPairBlock; ++j) task.force[axis][j] = 0;
    const std::int32_t last = smaller_of(block + kPairBlock, task.count);
    for (std::int32_t i = task.first; i < end; ++i) {
      OneOfAll<S> one(task, i);
      // From the lanes that hold the next particle on, in the block itself.
      std::int32_t j = block > i ? block : (i + 1) / S::kLanes * S::kLanes;
      for (; j < last; j += S::kLanes) act<S, kEnergy>(task, j, lanes_of<S>(task, i, j), one);
      for (int axis = 0; axis < 3; ++axis) task.own[i - task.first][axis] -= S::sum(one.force[axis]);
      if constexpr (kEnergy) energy += one.energy;
    }
  }
}

template <class S>
constexpr AllPairsKernels all_pairs_kernels{{all_pairs<S, false>, all_pairs<S, true>}};

}  // namespace
}  // namespace dch::detail
