// SPDX-License-Identifier: MIT
#include "clusters/simd/cluster_search_kernels_sets.hpp"
#include "clusters/simd/near_loops.hpp"
#include "clusters/simd/near_slots_loops.hpp"
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
  static std::uint32_t fours_below(V a, V b) {
    const V by = _mm512_subs_epu16(b, a);
    return _mm512_test_epi64_mask(by, by);
  }
  static V pairs(std::uint16_t mask) {
    return _mm512_set1_epi64(static_cast<long long>(0xFFFF0000FFFFFFFFULL | std::uint64_t{mask} << 32));
  }
  static V keep_pairs(V entries, V pairs) { return _mm512_and_si512(entries, pairs); }
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

}  // namespace

const ClusterSearchKernels& cluster_search_kernels_avx512() {
  static constexpr ClusterSearchKernels kKernels{keep_near<Avx512Fours>, find_row<Avx512Fours>,
                                                 refresh_clusters<Avx512Fours>, follow_clusters<Avx512Fours>,
                                                 near_slots<Avx512Float>};
  return kKernels;
}

}  // namespace dch::detail
