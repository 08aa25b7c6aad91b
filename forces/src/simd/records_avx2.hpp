// SPDX-License-Identifier: MIT
#pragma once

#include <immintrin.h>

#include "clusters/simd/vectors_avx2.hpp"
#include "simd/records.hpp"

namespace dch::detail {
namespace {

template <>
struct Records<Avx2Double> {
  using V = __m256d;

  static void transpose(V& a, V& b, V& c, V& d) {
    const V even_low = _mm256_unpacklo_pd(a, b), even_high = _mm256_unpacklo_pd(c, d);
    const V odd_low = _mm256_unpackhi_pd(a, b), odd_high = _mm256_unpackhi_pd(c, d);
    a = _mm256_permute2f128_pd(even_low, even_high, 0x20);
    b = _mm256_permute2f128_pd(odd_low, odd_high, 0x20);
    c = _mm256_permute2f128_pd(even_low, even_high, 0x31);
    d = _mm256_permute2f128_pd(odd_low, odd_high, 0x31);
  }

  template <int kStride>
  static void load(const double* from, const std::int32_t* at, V (&numbers)[4]) {
    for (int k = 0; k < 4; ++k)
      numbers[k] = _mm256_loadu_pd(from + kStride * static_cast<std::ptrdiff_t>(at[k]));
    transpose(numbers[0], numbers[1], numbers[2], numbers[3]);
  }

  static void subtract(const V (&numbers)[3], const std::int32_t* at, int lanes, double* from) {
    V less[4] = {numbers[0], numbers[1], numbers[2], _mm256_setzero_pd()};
    transpose(less[0], less[1], less[2], less[3]);
    for (int k = 0; k < lanes; ++k) {
      double* const record = from + 4 * static_cast<std::ptrdiff_t>(at[k]);
      _mm256_store_pd(record, _mm256_sub_pd(_mm256_load_pd(record), less[k]));
    }
  }

  static int append(std::uint32_t bits, const std::int32_t* at, V number, std::int32_t* to_at,
                    double* to_numbers) {
    alignas(32) double lanes[4];
    _mm256_store_pd(lanes, number);
    int count = 0;
    for (int k = 0; k < 4; ++k) {
      to_at[count] = at[k];
      to_numbers[count] = lanes[k];
      count += static_cast<int>(bits >> k & 1);
    }
    return count;
  }
};

}  // namespace
}  // namespace dch::detail
