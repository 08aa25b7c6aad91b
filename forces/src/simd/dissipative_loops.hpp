// SPDX-License-Identifier: MIT
//
// The forces of dissipative particle dynamics over vector types; see cluster_loops.hpp.
#pragma once

#include <algorithm>

#include "clusters/simd/cluster_loops.hpp"
#include "simd/dissipative_task.hpp"
#include "simd/noise_loops.hpp"

namespace dch::detail {
namespace {

/// Uniform in (-1/2, 1/2), one for each pair.
inline void noise_of_pairs(const DissipativeTask& task, const DissipativeBatch& batch, double* noise) {
  static_assert(PhiloxBlock::kCount == DissipativeBatch::kSize);
  PhiloxBlock block;
  for (std::size_t k = 0; k < PhiloxBlock::kCount; ++k) {
    block.word[0][k] = static_cast<std::uint32_t>(std::min(batch.first_id[k], batch.second_id[k]));
    block.word[1][k] = static_cast<std::uint32_t>(std::max(batch.first_id[k], batch.second_id[k]));
    block.word[2][k] = static_cast<std::uint32_t>(task.step);
    block.word[3][k] = static_cast<std::uint32_t>(task.step >> 32);
  }
  block.mix(task.seed, 1);
  for (std::size_t k = 0; k < PhiloxBlock::kCount; ++k) noise[k] = uniform_of(with_sign(block.word[0][k]));
}

template <class S>
void dissipative_pairs(const DissipativeTask& task, DissipativeBatch& batch) {
  using V = typename S::V;
  alignas(64) double noise[DissipativeBatch::kSize];
  noise_of_pairs(task, batch, noise);
  const V of_step = S::set1(task.noise), one = S::set1(1);
  for (int k = 0; k < batch.count; k += S::kLanes) {
    alignas(32) std::int32_t at[S::kLanes];
    for (int lane = 0; lane < S::kLanes; ++lane) {
      const int pair = std::min(k + lane, batch.count - 1);  // behind the last one are any numbers
      at[lane] = batch.kind[pair] * task.pairs_of_types + batch.types[pair];
    }
    const V x = S::load(batch.x + k), y = S::load(batch.y + k), z = S::load(batch.z + k);
    const V r2 = S::madd(x, x, S::madd(y, y, S::mul(z, z)));
    const V approach = S::madd(x, S::load(batch.vx + k),
                               S::madd(y, S::load(batch.vy + k), S::mul(z, S::load(batch.vz + k))));
    const V s = S::keep(S::less(S::set1(1e-20), r2, 0xFFFF, 0), S::inverse(r2));
    const V over_r = S::over_root(r2, s), r = S::mul(r2, over_r);
    const V left = S::sub(one, S::mul(r, S::gather(task.table[3], at)));
    const V w = S::keep(S::less(S::zero(), s, 0xFFFF, 0), S::max(left, S::zero()));
    const V drag = S::mul(S::mul(S::gather(task.table[1], at), w), S::mul(approach, over_r));
    const V kick = S::mul(S::mul(of_step, S::gather(task.table[2], at)), S::load(noise + k));
    const V force = S::mul(w, S::add(S::sub(S::gather(task.table[0], at), drag), kick));
    S::store(batch.force_over_r + k, S::mul(force, over_r));
    S::store(batch.energy + k, S::mul(S::mul(S::gather(task.table[4], at), w), w));
  }
}

template <class S>
inline constexpr DissipativeKernels dissipative_kernels{dissipative_pairs<S>};

}  // namespace
}  // namespace dch::detail
