// SPDX-License-Identifier: MIT
#pragma once

#include <immintrin.h>

#include "clusters/simd/vectors_avx2.hpp"
#include "simd/forms/knots.hpp"
#include "simd/records_avx2.hpp"

namespace dch::detail {
namespace {

template <>
struct TwoKnots<Avx2Double> {
  static void load(const double* table, __m256d n, __m256d (&numbers)[4]) {
    alignas(16) std::int32_t at[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(at), _mm256_cvttpd_epi32(n));
    Records<Avx2Double>::load<2>(table, at, numbers);
  }
};

template <>
struct TwoKnots<Avx2Float> {
  static void load(const float* table, __m256 n, __m256 (&numbers)[4]) {
    alignas(32) std::int32_t at[8];
    _mm256_store_si256(reinterpret_cast<__m256i*>(at), _mm256_cvttps_epi32(n));
    const auto two = [&](int lane) {
      return _mm256_set_m128(_mm_loadu_ps(table + 2 * static_cast<std::ptrdiff_t>(at[lane + 4])),
                             _mm_loadu_ps(table + 2 * static_cast<std::ptrdiff_t>(at[lane])));
    };
    const __m256 a = two(0), b = two(1), c = two(2), d = two(3);
    const __m256d low_ab = _mm256_castps_pd(_mm256_unpacklo_ps(a, b));
    const __m256d high_ab = _mm256_castps_pd(_mm256_unpackhi_ps(a, b));
    const __m256d low_cd = _mm256_castps_pd(_mm256_unpacklo_ps(c, d));
    const __m256d high_cd = _mm256_castps_pd(_mm256_unpackhi_ps(c, d));
    numbers[0] = _mm256_castpd_ps(_mm256_unpacklo_pd(low_ab, low_cd));
    numbers[1] = _mm256_castpd_ps(_mm256_unpackhi_pd(low_ab, low_cd));
    numbers[2] = _mm256_castpd_ps(_mm256_unpacklo_pd(high_ab, high_cd));
    numbers[3] = _mm256_castpd_ps(_mm256_unpackhi_pd(high_ab, high_cd));
  }
};

}  // namespace
}  // namespace dch::detail
