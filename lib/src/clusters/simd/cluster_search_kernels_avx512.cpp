// SPDX-License-Identifier: MIT
#include "clusters/simd/cluster_search_kernels_sets.hpp"
#include "clusters/simd/join_loops.hpp"
#include "clusters/simd/near_loops.hpp"
#include "clusters/simd/refresh_loops.hpp"
#include "clusters/simd/vectors_avx512.hpp"
#include "simd/lanes_avx512.hpp"

namespace dch::detail {
namespace {

/// Eight clusters in a register.
struct Avx512Fours : Avx512 {
  static V subs(V a, V b) { return _mm512_subs_epi16(a, b); }
  static V max(V a, V b) { return _mm512_max_epi16(a, b); }
  static V add_unsigned(V a, V b) { return _mm512_adds_epu16(a, b); }
  static V from_number(std::int32_t k) {
    alignas(64) static constexpr std::int16_t kFirst[kLanes] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10,
                                                                11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
                                                                22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
    return _mm512_add_epi16(set1(static_cast<std::int16_t>(k)), load(kFirst));
  }

  static constexpr int kFours = 8;
  using Four = Avx512Fours;
  struct Fours {
    V x, y, z, entry;
  };
  static __m256i whole(const NearCluster& cluster) {
    return _mm256_load_si256(reinterpret_cast<const __m256i*>(&cluster));
  }
  static Fours fours(const NearCluster* from, const std::int16_t* number) {
    const auto two = [&](int k) {
      return _mm512_inserti64x4(_mm512_castsi256_si512(whole(from[number[k]])), whole(from[number[k + 1]]),
                                1);
    };
    const V a = two(0), b = two(2), c = two(4), d = two(6);
    const V of_xy = _mm512_setr_epi64(0, 4, 8, 12, 1, 5, 9, 13);
    const V of_ze = _mm512_setr_epi64(2, 6, 10, 14, 3, 7, 11, 15);
    const V xy_of_ab = _mm512_permutex2var_epi64(a, of_xy, b),
            ze_of_ab = _mm512_permutex2var_epi64(a, of_ze, b);
    const V xy_of_cd = _mm512_permutex2var_epi64(c, of_xy, d),
            ze_of_cd = _mm512_permutex2var_epi64(c, of_ze, d);
    return {_mm512_shuffle_i64x2(xy_of_ab, xy_of_cd, 0x44), _mm512_shuffle_i64x2(xy_of_ab, xy_of_cd, 0xEE),
            _mm512_shuffle_i64x2(ze_of_ab, ze_of_cd, 0x44), _mm512_shuffle_i64x2(ze_of_ab, ze_of_cd, 0xEE)};
  }
  static V bits_where_below(V sum, V limit, int slot) {
    const V by = _mm512_subs_epu16(limit, sum), bits = _mm512_set1_epi64(bits_of_slot(slot));
    return _mm512_maskz_mov_epi16(_mm512_test_epi16_mask(by, by), bits);
  }
  static V either(V a, V b) { return _mm512_or_si512(a, b); }
  static V pairs(std::uint16_t mask) {
    return _mm512_set1_epi64(~kMasks | static_cast<long long>(std::uint64_t{mask} << 32));
  }
  static V keep_pairs(V entries, V near, V pairs) {
    const V of_two = either(near, _mm512_srli_epi64(near, 32)),
            all = either(of_two, _mm512_srli_epi64(of_two, 16));
    const V others = _mm512_set1_epi64(~kMasks);
    return _mm512_and_si512(_mm512_and_si512(entries, pairs), either(_mm512_slli_epi64(all, 32), others));
  }
  static V load_entries(const ClusterPairs::Entry* from) { return _mm512_loadu_si512(from); }
  static std::uint32_t with_bits(V entries, long long bits) {
    return _mm512_test_epi64_mask(entries, _mm512_set1_epi64(bits));
  }
  static std::int32_t append(std::uint32_t lanes, V entries, ClusterPairs::Entry* to) {
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi64(static_cast<__mmask8>(lanes), entries));
    return __builtin_popcount(lanes);
  }
  static void copy_moved(const NearCluster& from, const ClusterMove& move, NearCluster& to) {
    const auto part = [&](int k) {
      return _mm256_load_si256(reinterpret_cast<const __m256i*>(move.part[k]));
    };
    const __m256i moved = _mm256_adds_epi16(_mm256_adds_epi16(whole(from), part(0)), part(1));
    _mm256_store_si256(reinterpret_cast<__m256i*>(&to), moved);
  }
};

/// Masks in the lanes of one register.
struct Avx512Masks {
  using Masks = __m512i;
  static Masks of(const ClusterPairs::Entry* entries, std::int32_t count) {
    const auto eight = [&](int k) {
      const std::int32_t left = count - 8 * k;
      const auto lanes = static_cast<__mmask8>(left >= 8 ? 0xFF : left > 0 ? (1 << left) - 1 : 0);
      return _mm512_cvtepi64_epi16(_mm512_srli_epi64(_mm512_maskz_loadu_epi64(lanes, entries + 8 * k), 32));
    };
    const __m256i low = _mm256_set_m128i(eight(1), eight(0)), high = _mm256_set_m128i(eight(3), eight(2));
    return _mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
  }
  static Masks load(const std::uint16_t* mask) { return _mm512_loadu_si512(mask); }
  static std::uint32_t with_bits(Masks masks, int least) {
    const Masks nibble = _mm512_set1_epi8(15),
                bits_of_nibble =
                    _mm512_broadcast_i32x4(_mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4));
    const Masks low = _mm512_shuffle_epi8(bits_of_nibble, _mm512_and_si512(masks, nibble));
    const Masks high =
        _mm512_shuffle_epi8(bits_of_nibble, _mm512_and_si512(_mm512_srli_epi16(masks, 4), nibble));
    const Masks of_bytes = _mm512_add_epi8(low, high),
                of_masks = _mm512_maddubs_epi16(of_bytes, _mm512_set1_epi8(1));
    return _mm512_cmpge_epi16_mask(of_masks, _mm512_set1_epi16(static_cast<std::int16_t>(least)));
  }
  static void move_to_front(std::uint32_t lanes, Masks masks, std::uint16_t* to, std::uint16_t* number) {
    alignas(64) static constexpr std::uint16_t kNumber[kJoinedAtOnce] = {
        0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15,
        16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi16(lanes, masks));
    _mm512_storeu_si512(number, _mm512_maskz_compress_epi16(lanes, _mm512_load_si512(kNumber)));
  }
  static std::uint32_t without_bits_of(std::uint16_t one, Masks masks) {
    return _mm512_testn_epi16_mask(masks, _mm512_set1_epi16(static_cast<std::int16_t>(one)));
  }
};

}  // namespace

const ClusterSearchKernels& cluster_search_kernels_avx512() {
  static constexpr ClusterSearchKernels kKernels{
      keep_near<Avx512Fours>,       find_row<Avx512Fours>, refresh_clusters<Avx512Fours>,
      follow_clusters<Avx512Fours>, join<Avx512Masks>,     split<Avx512Fours>};
  return kKernels;
}

}  // namespace dch::detail
