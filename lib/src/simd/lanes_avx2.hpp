// SPDX-License-Identifier: MIT
//
// Lanes of 16 bits in registers of AVX2. See list_kernels_loops.hpp.
#pragma once

#include "simd/pack_table.hpp"
#include "simd/x86_blocks.hpp"

namespace dch::detail {
namespace {

constexpr PackBytes<8, 2> kPack16;

struct Avx2 : X86Blocks {
  using V = __m256i;
  static constexpr int kLanes = 16;
  static constexpr std::uint32_t kAll = 0xFFFF;

  static V load(const std::int16_t* p) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)); }
  static V set1(std::int16_t v) { return _mm256_set1_epi16(v); }
  static V sub(V a, V b) { return _mm256_sub_epi16(a, b); }
  static V adds(V a, V b) { return _mm256_adds_epi16(a, b); }
  static V abs(V a) { return _mm256_abs_epi16(a); }
  static V above(V a, V b) { return _mm256_subs_epu16(a, b); }
  static V square(V d) { return _mm256_mulhrs_epi16(d, d); }
  static std::uint32_t bits_of(V lanes) {
    const __m128i bytes = _mm_packs_epi16(_mm256_castsi256_si128(lanes), _mm256_extracti128_si256(lanes, 1));
    return static_cast<std::uint32_t>(_mm_movemask_epi8(bytes));
  }
  static std::uint32_t bits_greater(V a, V b) { return bits_of(_mm256_cmpgt_epi16(a, b)); }
  static V least(V a, V b) { return _mm256_min_epu16(a, b); }
  static std::uint32_t bits_below(V a, V b) {
    return bits_of(_mm256_cmpeq_epi16(_mm256_subs_epu16(b, a), _mm256_setzero_si256())) ^ kAll;
  }
  static bool any_below(V a, std::uint16_t b) {
    const V below = _mm256_subs_epu16(set1(static_cast<std::int16_t>(b)), a);
    return _mm256_testz_si256(below, below) == 0;
  }
  /// The low and the high bytes of the limits, in both halves.
  struct Table {
    V low, high;
  };
  static Table table(const std::int16_t* limits) {
    const BytePair bytes = bytes_of(limits);
    return {_mm256_broadcastsi128_si256(bytes.low), _mm256_broadcastsi128_si256(bytes.high)};
  }
  static V look_up(const Table& table, V k) {
    const V low = _mm256_shuffle_epi8(table.low, k), high = _mm256_shuffle_epi8(table.high, k);
    return _mm256_or_si256(_mm256_and_si256(low, set1(0xFF)), _mm256_slli_epi16(high, 8));
  }
  static void move_to_front(std::uint32_t lanes, V tags, std::int16_t* to) {
    store(to, packed16(_mm256_castsi256_si128(tags), kPack16.bytes[lanes & 255]));
    store(to + __builtin_popcount(lanes & 255),
          packed16(_mm256_extracti128_si256(tags, 1), kPack16.bytes[lanes >> 8]));
  }
  static std::int32_t move_to_front(std::uint32_t lanes, V px, V py, V pz, const std::int32_t* from,
                                    std::int16_t* x, std::int16_t* y, std::int16_t* z, std::int32_t* to) {
    const unsigned char* low = kPack16.bytes[lanes & 255];
    const unsigned char* high = kPack16.bytes[lanes >> 8];
    const int first = __builtin_popcount(lanes & 255);
    store(x, packed16(_mm256_castsi256_si128(px), low));
    store(x + first, packed16(_mm256_extracti128_si256(px, 1), high));
    store(y, packed16(_mm256_castsi256_si128(py), low));
    store(y + first, packed16(_mm256_extracti128_si256(py, 1), high));
    store(z, packed16(_mm256_castsi256_si128(pz), low));
    store(z + first, packed16(_mm256_extracti128_si256(pz, 1), high));
    return compress_lanes(lanes, kLanes, from, to);
  }
  static std::int32_t compress_chunk(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    return compress_lanes(mask, kChunk, ids, out);
  }
  using Id = V;
  static Id set1_id(std::int32_t id) { return _mm256_set1_epi32(id); }
  static std::uint32_t lanes_of_either(const std::int32_t* ids, Id a, Id b) {
    std::uint32_t lanes = 0;
    for (int k = 0; k < kChunk; k += 8) {
      const V here = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids + k));
      const V equal = _mm256_or_si256(_mm256_cmpeq_epi32(here, a), _mm256_cmpeq_epi32(here, b));
      lanes |= static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(equal))) << k;
    }
    return lanes;
  }
  static constexpr int kIds = 8;
  static std::uint32_t equal_ids(const std::int32_t* ids, std::int32_t id) {
    const __m256i equal =
        _mm256_cmpeq_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids)), _mm256_set1_epi32(id));
    return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(equal)));
  }
  static std::int32_t compress_ids(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    return compress_lanes(mask, kIds, ids, out);
  }
  static std::int32_t compress_lanes(std::uint32_t mask, int count, const std::int32_t* ids,
                                     std::int32_t* out) {
    std::int32_t written = 0;
    for (int k = 0; k < count; k += 8, mask >>= 8) {
      const std::uint32_t eight = mask & 255;
      const __m256i order =
          _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(kPack.lanes[eight])));
      const __m256i from = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids + k));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + written),
                          _mm256_permutevar8x32_epi32(from, order));
      written += __builtin_popcount(eight);
    }
    return written;
  }
};

}  // namespace
}  // namespace dch::detail
