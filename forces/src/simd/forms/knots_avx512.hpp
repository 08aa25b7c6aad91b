// SPDX-License-Identifier: MIT
//
// By loads of whole knots: gathers of each number take longer (Zen 4).
#pragma once

#include <immintrin.h>

#include "clusters/simd/vectors_avx512.hpp"
#include "simd/forms/knots.hpp"
#include "simd/records_avx512.hpp"

namespace dch::detail {
namespace {

template <>
struct TwoKnots<Avx512Double> {
  static void load(const double* table, __m512d n, __m512d (&numbers)[4]) {
    alignas(32) std::int32_t at[8];
    _mm256_store_si256(reinterpret_cast<__m256i*>(at), _mm512_cvttpd_epi32(n));
    Records<Avx512Double>::load<2>(table, at, numbers);
  }
};

template <>
struct TwoKnots<Avx512Float> {
  static void load(const float* table, __m512 n, __m512 (&numbers)[4]) {
    alignas(64) std::int32_t at[16];
    _mm512_store_si512(at, _mm512_cvttps_epi32(n));
    const auto knots = [&](int lane) {
      return _mm_loadu_ps(table + 2 * static_cast<std::ptrdiff_t>(at[lane]));
    };
    const auto four = [&](int lane) {
      const __m512 first = _mm512_castps128_ps512(knots(lane));
      return _mm512_insertf32x4(
          _mm512_insertf32x4(_mm512_insertf32x4(first, knots(lane + 4), 1), knots(lane + 8), 2),
          knots(lane + 12), 3);
    };
    const __m512 a = four(0), b = four(1), c = four(2), d = four(3);
    const __m512d low_ab = _mm512_castps_pd(_mm512_unpacklo_ps(a, b));
    const __m512d high_ab = _mm512_castps_pd(_mm512_unpackhi_ps(a, b));
    const __m512d low_cd = _mm512_castps_pd(_mm512_unpacklo_ps(c, d));
    const __m512d high_cd = _mm512_castps_pd(_mm512_unpackhi_ps(c, d));
    numbers[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(low_ab, low_cd));
    numbers[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(low_ab, low_cd));
    numbers[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(high_ab, high_cd));
    numbers[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(high_ab, high_cd));
  }
};

}  // namespace
}  // namespace dch::detail
