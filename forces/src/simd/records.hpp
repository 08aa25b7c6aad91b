// SPDX-License-Identifier: MIT
//
// Records of four doubles each, beside each other in memory, one for each lane.
#pragma once

#include <cstdint>

#include "clusters/simd/cluster_loops.hpp"

namespace dch::detail {
namespace {

/// For instruction sets without faster ones.
template <class S>
struct Records {
  using V = typename S::V;

  /// First to fourth numbers of records that begin at these multiples of `kStride` doubles.
  template <int kStride>
  static void load(const double* from, const std::int32_t* at, V (&numbers)[4]) {
    alignas(64) double lanes[4][S::kLanes];
    for (int k = 0; k < S::kLanes; ++k) {
      const double* const record = from + kStride * static_cast<std::ptrdiff_t>(at[k]);
      for (int n = 0; n < 4; ++n) lanes[n][k] = record[n];
    }
    for (int n = 0; n < 4; ++n) numbers[n] = S::load(lanes[n]);
  }

  /// Subtracts x, y and z of the first lanes from records of four.
  static void subtract(const V (&numbers)[3], const std::int32_t* at, int lanes, double* from) {
    alignas(64) double less[3][S::kLanes];
    for (int n = 0; n < 3; ++n) S::store(less[n], numbers[n]);
    for (int k = 0; k < lanes; ++k) {
      double* const record = from + 4 * static_cast<std::ptrdiff_t>(at[k]);
      for (int n = 0; n < 3; ++n) record[n] -= less[n][k];
    }
  }

  /// Writes the lanes whose bits are set one behind the other; others may be written behind them.
  /// @returns how many
  static int append(std::uint32_t bits, const std::int32_t* at, V number, std::int32_t* to_at,
                    double* to_numbers) {
    alignas(64) double lanes[S::kLanes];
    S::store(lanes, number);
    int count = 0;
    for (int k = 0; k < S::kLanes; ++k) {
      to_at[count] = at[k];
      to_numbers[count] = lanes[k];
      count += static_cast<int>(bits >> k & 1);
    }
    return count;
  }
};

}  // namespace
}  // namespace dch::detail
