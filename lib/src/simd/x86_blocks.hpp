// SPDX-License-Identifier: MIT
//
// What the x86 sets have in common: one coordinate of a block's points fills a 128-bit register.
// See list_kernels_loops.hpp for the rules.
#pragma once

#include <immintrin.h>

#include "simd/list_kernels.hpp"
#include "simd/pack_bytes.hpp"

namespace dch::detail {
namespace {

struct X86Blocks {
  static __m128i packed16(__m128i lanes, const unsigned char* order) {
    return _mm_shuffle_epi8(lanes, _mm_load_si128(reinterpret_cast<const __m128i*>(order)));
  }
  static void store(std::int16_t* to, __m128i lanes) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), lanes);
  }
  /// The low and the high bytes of 16 numbers.
  struct BytePair {
    __m128i low, high;
  };
  static BytePair bytes_of(const std::int16_t* numbers) {
    const __m128i first = _mm_load_si128(reinterpret_cast<const __m128i*>(numbers)),
                  second = _mm_load_si128(reinterpret_cast<const __m128i*>(numbers + 8));
    const __m128i byte = _mm_set1_epi16(0xFF);
    return {_mm_packus_epi16(_mm_and_si128(first, byte), _mm_and_si128(second, byte)),
            _mm_packus_epi16(_mm_srli_epi16(first, 8), _mm_srli_epi16(second, 8))};
  }
  static void copy_shifted(const std::int16_t* from, std::int16_t shift, std::int16_t* to) {
    const __m128i points = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_add_epi16(points, _mm_set1_epi16(shift)));
  }
  static void copy_saturated(const std::int16_t* from, const std::int16_t shift[2], std::int16_t* to) {
    const __m128i points = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
    const __m128i part = _mm_adds_epi16(points, _mm_set1_epi16(shift[0]));
    store(to, _mm_adds_epi16(part, _mm_set1_epi16(shift[1])));
  }
  static void copy_ids(const std::int32_t* from, std::int32_t* to) {
    const __m128i low = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
    const __m128i high = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from + 4));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), low);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to + 4), high);
  }
};

}  // namespace
}  // namespace dch::detail
