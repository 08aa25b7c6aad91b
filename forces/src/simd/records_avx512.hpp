// SPDX-License-Identifier: MIT
#pragma once

#include <immintrin.h>

#include "clusters/simd/vectors_avx512.hpp"
#include "simd/records.hpp"

namespace dch::detail {
namespace {

template <>
struct Records<Avx512Double> {
  using V = __m512d;

  template <int kStride>
  static void load(const double* from, const std::int32_t* at, V (&numbers)[4]) {
    const auto record = [&](int lane) {
      return _mm256_loadu_pd(from + kStride * static_cast<std::ptrdiff_t>(at[lane]));
    };
    const auto two = [&](int lane) {
      return _mm512_insertf64x4(_mm512_castpd256_pd512(record(lane)), record(lane + 2), 1);
    };
    const V a = two(0), b = two(1), c = two(4), d = two(5);
    const V even_low = _mm512_unpacklo_pd(a, b), even_high = _mm512_unpacklo_pd(c, d);
    const V odd_low = _mm512_unpackhi_pd(a, b), odd_high = _mm512_unpackhi_pd(c, d);
    numbers[0] = _mm512_shuffle_f64x2(even_low, even_high, 0x88);
    numbers[1] = _mm512_shuffle_f64x2(odd_low, odd_high, 0x88);
    numbers[2] = _mm512_shuffle_f64x2(even_low, even_high, 0xDD);
    numbers[3] = _mm512_shuffle_f64x2(odd_low, odd_high, 0xDD);
  }

  static void subtract(const V (&numbers)[3], const std::int32_t* at, int lanes, double* from) {
    const V xy_even = _mm512_unpacklo_pd(numbers[0], numbers[1]);
    const V xy_odd = _mm512_unpackhi_pd(numbers[0], numbers[1]);
    const V z_even = _mm512_unpacklo_pd(numbers[2], _mm512_setzero_pd());
    const V z_odd = _mm512_unpackhi_pd(numbers[2], _mm512_setzero_pd());
    // Of lanes 0 and 4, 2 and 6, 1 and 5, 3 and 7.
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i second = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    const V pairs[4] = {
        _mm512_permutex2var_pd(xy_even, first, z_even), _mm512_permutex2var_pd(xy_odd, first, z_odd),
        _mm512_permutex2var_pd(xy_even, second, z_even), _mm512_permutex2var_pd(xy_odd, second, z_odd)};
    const auto subtract_from = [&](int lane, __m256d less) {
      double* const record = from + 4 * static_cast<std::ptrdiff_t>(at[lane]);
      _mm256_store_pd(record, _mm256_sub_pd(_mm256_load_pd(record), less));
    };
    if (lanes == 8) {
      for (int k = 0; k < 4; ++k) subtract_from(k, _mm512_castpd512_pd256(pairs[k]));
      for (int k = 0; k < 4; ++k) subtract_from(k + 4, _mm512_extractf64x4_pd(pairs[k], 1));
      return;
    }
    for (int k = 0; k < lanes; ++k)
      subtract_from(k, k < 4 ? _mm512_castpd512_pd256(pairs[k]) : _mm512_extractf64x4_pd(pairs[k - 4], 1));
  }

  /// By registers: writing compressed ones to memory takes tens of cycles on AMD's Zen 4.
  static int append(std::uint32_t bits, const std::int32_t* at, V number, std::int32_t* to_at,
                    double* to_numbers) {
    const auto lanes = static_cast<__mmask8>(bits);
    const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to_at), _mm256_maskz_compress_epi32(lanes, all));
    _mm512_storeu_pd(to_numbers, _mm512_maskz_compress_pd(lanes, number));
    return __builtin_popcount(bits);
  }
};

}  // namespace
}  // namespace dch::detail
