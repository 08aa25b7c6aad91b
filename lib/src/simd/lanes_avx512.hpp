// SPDX-License-Identifier: MIT
//
// Lanes of 16 bits in registers of AVX-512. See list_kernels_loops.hpp.
#pragma once

#include "simd/x86_blocks.hpp"

namespace dch::detail {
namespace {

struct Avx512 : X86Blocks {
  using V = __m512i;
  static constexpr int kLanes = 32;
  static constexpr std::uint32_t kAll = 0xFFFFFFFF;

  static V load(const std::int16_t* p) { return _mm512_loadu_si512(p); }
  static V set1(std::int16_t v) { return _mm512_set1_epi16(v); }
  static V sub(V a, V b) { return _mm512_sub_epi16(a, b); }
  static V adds(V a, V b) { return _mm512_adds_epi16(a, b); }
  static V abs(V a) { return _mm512_abs_epi16(a); }
  static V above(V a, V b) { return _mm512_subs_epu16(a, b); }
  static V square(V d) { return _mm512_mulhrs_epi16(d, d); }
  static std::uint32_t bits_greater(V a, V b) { return _mm512_cmpgt_epi16_mask(a, b); }
  static V least(V a, V b) { return _mm512_min_epu16(a, b); }
  static std::uint32_t bits_below(V a, V b) { return _mm512_cmplt_epu16_mask(a, b); }
  static bool any_below(V a, std::uint16_t b) {
    return bits_below(a, set1(static_cast<std::int16_t>(b))) != 0;
  }
  using Table = V;
  static Table table(const std::int16_t* limits) {
    return _mm512_castsi256_si512(_mm256_load_si256(reinterpret_cast<const __m256i*>(limits)));
  }
  static V look_up(Table table, V k) { return _mm512_permutexvar_epi16(k, table); }
  static void move_to_front(std::uint32_t lanes, V tags, std::int16_t* to) {
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi16(lanes, tags));
  }
  static std::int32_t move_to_front(std::uint32_t lanes, V px, V py, V pz, const std::int32_t* from,
                                    std::int16_t* x, std::int16_t* y, std::int16_t* z, std::int32_t* to) {
    _mm512_storeu_si512(x, _mm512_maskz_compress_epi16(lanes, px));
    _mm512_storeu_si512(y, _mm512_maskz_compress_epi16(lanes, py));
    _mm512_storeu_si512(z, _mm512_maskz_compress_epi16(lanes, pz));
    return compress_chunk(lanes, from, to);
  }
  using Id = V;
  static Id set1_id(std::int32_t id) { return _mm512_set1_epi32(id); }
  static std::uint32_t lanes_of_either(const std::int32_t* ids, Id a, Id b) {
    const auto in_half = [&](const std::int32_t* half) {
      const V of_half = _mm512_loadu_si512(half);
      return static_cast<__mmask16>(_mm512_cmpeq_epi32_mask(of_half, a) |
                                    _mm512_cmpeq_epi32_mask(of_half, b));
    };
    return _mm512_kunpackw(in_half(ids + 16), in_half(ids));
  }
  static constexpr int kIds = 16;
  static std::uint32_t equal_ids(const std::int32_t* ids, std::int32_t id) {
    return _mm512_cmpeq_epi32_mask(_mm512_loadu_si512(ids), _mm512_set1_epi32(id));
  }
  static std::int32_t compress_ids(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    const __m512i front = _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), _mm512_loadu_si512(ids));
    _mm512_storeu_si512(out, front);
    return __builtin_popcount(mask);
  }
  static std::int32_t compress_lanes(std::uint32_t mask, int, const std::int32_t* ids, std::int32_t* out) {
    return compress_chunk(mask, ids, out);
  }
  // Compressed in a register, then stored whole: a compressing store is many times slower on some processors.
  static std::int32_t compress_chunk(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    const auto low = static_cast<__mmask16>(mask), high = static_cast<__mmask16>(mask >> 16);
    const int first = __builtin_popcount(mask & 0xFFFF);
    const __m512i ids_low = _mm512_loadu_si512(ids), ids_high = _mm512_loadu_si512(ids + 16);
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(low, ids_low));
    _mm512_storeu_si512(out + first, _mm512_maskz_compress_epi32(high, ids_high));
    return __builtin_popcount(mask);
  }
};

}  // namespace
}  // namespace dch::detail
