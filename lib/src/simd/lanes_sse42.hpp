// SPDX-License-Identifier: MIT
//
// Lanes of 16 bits in registers of SSE4.2. See list_kernels_loops.hpp.
#pragma once

#include "simd/x86_blocks.hpp"

namespace dch::detail {
namespace {

constexpr PackBytes<8, 2> kPack16;
constexpr PackBytes<4, 4> kPack32;

struct Sse42 : X86Blocks {
  using V = __m128i;
  static constexpr int kLanes = 8;
  static constexpr std::uint32_t kAll = 0xFF;

  static V load(const std::int16_t* p) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p)); }
  static V set1(std::int16_t v) { return _mm_set1_epi16(v); }
  static V sub(V a, V b) { return _mm_sub_epi16(a, b); }
  static V adds(V a, V b) { return _mm_adds_epi16(a, b); }
  static V abs(V a) { return _mm_abs_epi16(a); }
  static V above(V a, V b) { return _mm_subs_epu16(a, b); }
  static V square(V d) { return _mm_mulhrs_epi16(d, d); }
  static std::uint32_t bits_of(V lanes) {
    return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(lanes, _mm_setzero_si128())));
  }
  static std::uint32_t bits_greater(V a, V b) { return bits_of(_mm_cmpgt_epi16(a, b)); }
  static V least(V a, V b) { return _mm_min_epu16(a, b); }
  static std::uint32_t bits_below(V a, V b) {
    return bits_of(_mm_cmpeq_epi16(_mm_subs_epu16(b, a), _mm_setzero_si128())) ^ kAll;
  }
  static bool any_below(V a, std::uint16_t b) {
    const V below = _mm_subs_epu16(set1(static_cast<std::int16_t>(b)), a);
    return _mm_testz_si128(below, below) == 0;
  }
  using Table = BytePair;
  static Table table(const std::int16_t* limits) { return bytes_of(limits); }
  static V look_up(const Table& table, V k) {
    const V low = _mm_shuffle_epi8(table.low, k), high = _mm_shuffle_epi8(table.high, k);
    return _mm_or_si128(_mm_and_si128(low, set1(0xFF)), _mm_slli_epi16(high, 8));
  }
  static void move_to_front(std::uint32_t lanes, V tags, std::int16_t* to) {
    store(to, packed16(tags, kPack16.bytes[lanes]));
  }
  static std::int32_t move_to_front(std::uint32_t lanes, V px, V py, V pz, const std::int32_t* from,
                                    std::int16_t* x, std::int16_t* y, std::int16_t* z, std::int32_t* to) {
    store(x, packed16(px, kPack16.bytes[lanes]));
    store(y, packed16(py, kPack16.bytes[lanes]));
    store(z, packed16(pz, kPack16.bytes[lanes]));
    return compress_lanes(lanes, kLanes, from, to);
  }
  static std::int32_t compress_chunk(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    return compress_lanes(mask, kChunk, ids, out);
  }
  using Id = V;
  static Id set1_id(std::int32_t id) { return _mm_set1_epi32(id); }
  static std::uint32_t lanes_of_either(const std::int32_t* ids, Id a, Id b) {
    std::uint32_t lanes = 0;
    for (int k = 0; k < kChunk; k += 4) {
      const V here = _mm_loadu_si128(reinterpret_cast<const __m128i*>(ids + k));
      const V equal = _mm_or_si128(_mm_cmpeq_epi32(here, a), _mm_cmpeq_epi32(here, b));
      lanes |= static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(equal))) << k;
    }
    return lanes;
  }
  static constexpr int kIds = 4;
  static std::uint32_t equal_ids(const std::int32_t* ids, std::int32_t id) {
    const __m128i equal =
        _mm_cmpeq_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(ids)), _mm_set1_epi32(id));
    return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(equal)));
  }
  static std::int32_t compress_ids(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    return compress_lanes(mask, kIds, ids, out);
  }
  static std::int32_t compress_lanes(std::uint32_t mask, int count, const std::int32_t* ids,
                                     std::int32_t* out) {
    std::int32_t written = 0;
    for (int k = 0; k < count; k += 4, mask >>= 4) {
      const std::uint32_t four = mask & 15;
      const __m128i order = _mm_load_si128(reinterpret_cast<const __m128i*>(kPack32.bytes[four]));
      const __m128i from = _mm_loadu_si128(reinterpret_cast<const __m128i*>(ids + k));
      _mm_storeu_si128(reinterpret_cast<__m128i*>(out + written), _mm_shuffle_epi8(from, order));
      written += __builtin_popcount(four);
    }
    return written;
  }
};

}  // namespace
}  // namespace dch::detail
