// SPDX-License-Identifier: MIT
#include "frozen/frozen_kernels_loops.hpp"
#include "simd/x86_blocks.hpp"

namespace dch::bench {
namespace {

/// By a mask of 8 lanes: the chosen lanes, first come first.
struct PackTable {
  alignas(32) unsigned char lanes[256][8]{};
  constexpr PackTable() {
    for (int mask = 0; mask < 256; ++mask) {
      int to = 0;
      for (int lane = 0; lane < 8; ++lane)
        if ((mask >> lane & 1) != 0) lanes[mask][to++] = static_cast<unsigned char>(lane);
    }
  }
};
constexpr PackTable kPack;
constexpr detail::PackBytes<8, 2> kPack16;

struct Avx2 : detail::X86Blocks {
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
  static std::uint32_t bits_greater(V a, V b) {
    const __m256i greater = _mm256_cmpgt_epi16(a, b);
    const __m128i bytes =
        _mm_packs_epi16(_mm256_castsi256_si128(greater), _mm256_extracti128_si256(greater, 1));
    return static_cast<std::uint32_t>(_mm_movemask_epi8(bytes));
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

const FrozenKernels& frozen_kernels_avx2() {
  static constexpr FrozenKernels kKernels = kernels_of<Avx2>;
  return kKernels;
}

}  // namespace dch::bench
