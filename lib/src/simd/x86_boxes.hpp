// SPDX-License-Identifier: MIT
//
// What the x86 sets have in common: boxes fill one 128-bit register. See list_kernels_loops.hpp for the
// rules.
#pragma once

#include <immintrin.h>

#include "list_kernels.hpp"

namespace dch::detail {
namespace {

struct X86Boxes {
  static __m128i load_box(const BlockBox& box) {
    return _mm_load_si128(reinterpret_cast<const __m128i*>(box.v));
  }
  static void store_box(BlockBox& to, __m128i box) { _mm_store_si128(reinterpret_cast<__m128i*>(to.v), box); }
  static __m128i shift_box(__m128i box, __m128i shift) { return _mm_adds_epi16(box, shift); }
  static int box_gap2(__m128i box, __m128i opposite) {
    const __m128i gap = _mm_max_epi16(_mm_subs_epi16(box, opposite), _mm_setzero_si128());
    __m128i sum = _mm_mulhrs_epi16(gap, gap);
    sum = _mm_adds_epi16(sum, _mm_srli_si128(sum, 8));
    sum = _mm_adds_epi16(sum, _mm_srli_si128(sum, 4));
    sum = _mm_adds_epi16(sum, _mm_srli_si128(sum, 2));
    return static_cast<std::int16_t>(_mm_cvtsi128_si32(sum));
  }
};

}  // namespace
}  // namespace dch::detail
