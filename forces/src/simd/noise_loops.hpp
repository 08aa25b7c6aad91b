// SPDX-License-Identifier: MIT
//
// Random numbers and the forces of a bath: plain loops, of which the compiler makes vectors of each
// instruction set. All but the last steps are integers, and no product is fused with a sum
// (-ffp-contract=off).
#pragma once

#include <algorithm>

#include "simd/noise_task.hpp"
#include "simd/philox.hpp"
#include "simd/ranmar_loops.hpp"

namespace dch::detail {
namespace {

/// Philox for as many counters at once as fit into the nearest cache with room for all loads and stores to
/// overlap.
struct PhiloxBlock {
  static constexpr std::size_t kCount = 64;
  std::uint32_t word[4][kCount];

  /// One round with both halves of the key.
  void turn(std::uint32_t key0, std::uint32_t key1) {
    for (std::size_t k = 0; k < kCount; ++k) {
      const std::uint64_t even = std::uint64_t{kPhiloxFactors[0]} * word[0][k];
      const std::uint64_t odd = std::uint64_t{kPhiloxFactors[1]} * word[2][k];
      const auto high_of_even = static_cast<std::uint32_t>(even >> 32);
      const auto high_of_odd = static_cast<std::uint32_t>(odd >> 32);
      word[0][k] = high_of_odd ^ word[1][k] ^ key0;
      word[1][k] = static_cast<std::uint32_t>(odd);
      word[2][k] = high_of_even ^ word[3][k] ^ key1;
      word[3][k] = static_cast<std::uint32_t>(even);
    }
  }

  /// All rounds.
  void mix(std::uint32_t key0, std::uint32_t key1) {
    for (int round = 0; round < kPhiloxRounds; ++round) {
      turn(key0, key1);
      key0 += kPhiloxSteps[0];
      key1 += kPhiloxSteps[1];
    }
  }
};

/// A word less 2^31, which converts faster than a number without a sign.
inline std::int32_t with_sign(std::uint32_t word) { return static_cast<std::int32_t>(word ^ 0x80000000u); }
/// Such a word as a number in (-1/2, 1/2).
inline double uniform_of(std::int32_t word) { return (word + 0.5) * 0x1p-32; }

/// The block of the IDs from `first` on; counters behind the last one are those of ID 0.
inline PhiloxBlock philox_block(const NoiseTask& task, std::size_t first, std::size_t count) {
  PhiloxBlock block;
  for (std::size_t k = 0; k < PhiloxBlock::kCount; ++k) {
    block.word[0][k] = k < count ? static_cast<std::uint32_t>(task.ids[first + k]) : 0;
    block.word[1][k] = static_cast<std::uint32_t>(task.step);
    block.word[2][k] = static_cast<std::uint32_t>(task.step >> 32);
    block.word[3][k] = 0;
  }
  block.mix(task.seed, 0);
  return block;
}

inline void noise_uniform(const NoiseTask& task) {
  double* const to = &task.noise->x;
  for (std::size_t first = 0; first < task.count; first += PhiloxBlock::kCount) {
    const std::size_t count = std::min(PhiloxBlock::kCount, task.count - first);
    const PhiloxBlock block = philox_block(task, first, count);
    std::int32_t signed_word[3 * PhiloxBlock::kCount];
    for (std::size_t k = 0; k < PhiloxBlock::kCount; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) signed_word[3 * k + axis] = with_sign(block.word[axis][k]);
    for (std::size_t k = 0; k < 3 * count; ++k) to[3 * first + k] = uniform_of(signed_word[k]);
  }
}

inline void noise_langevin(const LangevinTask& task) {
  const double* const __restrict drag = task.drag;
  const double* const __restrict strength = task.strength;
  const double* const __restrict velocity = &task.velocities->x;
  const double* const __restrict noise = &task.noise->x;
  double* const __restrict force = &task.forces->x;
  for (std::size_t i = 0; i < task.count; ++i)
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
      force[k] += drag[i] * velocity[k] + strength[i] * noise[k];
}

inline constexpr NoiseKernels noise_kernels{noise_uniform, noise_ranmar, noise_langevin};

}  // namespace
}  // namespace dch::detail
