// SPDX-License-Identifier: MIT
#include "clusters/simd/cluster_search_kernels_sets.hpp"
#include "clusters/simd/join_loops.hpp"
#include "clusters/simd/near_loops.hpp"
#include "clusters/simd/refresh_loops.hpp"
#include "clusters/simd/vectors_avx2.hpp"
#include "simd/lanes_avx2.hpp"

namespace dch::detail {
namespace {

/// By a mask of 4 lanes of 64 bits: the halves of the chosen lanes, first come first.
struct PackTable64 {
  alignas(32) std::int32_t halves[16][8]{};
  constexpr PackTable64() {
    for (int mask = 0; mask < 16; ++mask) {
      int to = 0;
      for (int lane = 0; lane < 4; ++lane)
        for (int half = 0; (mask >> lane & 1) != 0 && half < 2; ++half) halves[mask][to++] = 2 * lane + half;
    }
  }
};
constexpr PackTable64 kPack64;

/// Four clusters in a register.
struct Avx2Fours : Avx2 {
  static V subs(V a, V b) { return _mm256_subs_epi16(a, b); }
  static V max(V a, V b) { return _mm256_max_epi16(a, b); }
  static V add_unsigned(V a, V b) { return _mm256_adds_epu16(a, b); }
  static V from_number(std::int32_t k) {
    return _mm256_add_epi16(set1(static_cast<std::int16_t>(k)),
                            _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
  }

  static constexpr int kFours = 4;
  using Four = Avx2Fours;
  struct Fours {
    V x, y, z, entry;
  };
  static V whole(const NearCluster& cluster) {
    return _mm256_load_si256(reinterpret_cast<const __m256i*>(&cluster));
  }
  static Fours fours(const NearCluster* from, const std::int16_t* number) {
    const V a = whole(from[number[0]]), b = whole(from[number[1]]), c = whole(from[number[2]]),
            d = whole(from[number[3]]);
    const V xz_of_ab = _mm256_unpacklo_epi64(a, b), ye_of_ab = _mm256_unpackhi_epi64(a, b);
    const V xz_of_cd = _mm256_unpacklo_epi64(c, d), ye_of_cd = _mm256_unpackhi_epi64(c, d);
    return {_mm256_permute2x128_si256(xz_of_ab, xz_of_cd, 0x20),
            _mm256_permute2x128_si256(ye_of_ab, ye_of_cd, 0x20),
            _mm256_permute2x128_si256(xz_of_ab, xz_of_cd, 0x31),
            _mm256_permute2x128_si256(ye_of_ab, ye_of_cd, 0x31)};
  }
  static V bits_where_below(V sum, V limit, int slot) {
    const V beyond = _mm256_cmpeq_epi16(_mm256_subs_epu16(limit, sum), _mm256_setzero_si256());
    return _mm256_andnot_si256(beyond, _mm256_set1_epi64x(bits_of_slot(slot)));
  }
  static V either(V a, V b) { return _mm256_or_si256(a, b); }
  static V pairs(std::uint16_t mask) {
    return _mm256_set1_epi64x(~kMasks | static_cast<long long>(std::uint64_t{mask} << 32));
  }
  static V keep_pairs(V entries, V near, V pairs) {
    const V of_two = either(near, _mm256_srli_epi64(near, 32)),
            all = either(of_two, _mm256_srli_epi64(of_two, 16));
    const V others = _mm256_set1_epi64x(~kMasks);
    return _mm256_and_si256(_mm256_and_si256(entries, pairs), either(_mm256_slli_epi64(all, 32), others));
  }
  static V load_entries(const ClusterPairs::Entry* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  }
  static std::uint32_t with_bits(V entries, long long bits) {
    const V none =
        _mm256_cmpeq_epi64(_mm256_and_si256(entries, _mm256_set1_epi64x(bits)), _mm256_setzero_si256());
    return static_cast<std::uint32_t>(_mm256_movemask_pd(_mm256_castsi256_pd(none))) ^ 15u;
  }
  static std::int32_t append(std::uint32_t lanes, V entries, ClusterPairs::Entry* to) {
    const V order = _mm256_load_si256(reinterpret_cast<const __m256i*>(kPack64.halves[lanes]));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(entries, order));
    return __builtin_popcount(lanes);
  }
  static void copy_moved(const NearCluster& from, const ClusterMove& move, NearCluster& to) {
    const auto part = [&](int k) {
      return _mm256_load_si256(reinterpret_cast<const __m256i*>(move.part[k]));
    };
    _mm256_store_si256(reinterpret_cast<__m256i*>(&to), adds(adds(whole(from), part(0)), part(1)));
  }
};

}  // namespace

const ClusterSearchKernels& cluster_search_kernels_avx2() {
  static constexpr ClusterSearchKernels kKernels{
      keep_near<Avx2Fours>,       find_row<Avx2Fours>, refresh_clusters<Avx2Fours>,
      follow_clusters<Avx2Fours>, join<PlainMasks>,    split<Avx2Fours>};
  return kKernels;
}

}  // namespace dch::detail
