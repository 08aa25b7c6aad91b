// SPDX-License-Identifier: MIT
#include "clusters/simd/cluster_search_kernels_sets.hpp"
#include "clusters/simd/join_loops.hpp"
#include "clusters/simd/near_loops.hpp"
#include "clusters/simd/refresh_loops.hpp"
#include "clusters/simd/vectors_sse42.hpp"
#include "simd/lanes_sse42.hpp"

namespace dch::detail {
namespace {

constexpr PackBytes<2, 8> kPack64;

/// Two clusters in a register.
struct Sse42Fours : Sse42 {
  static V subs(V a, V b) { return _mm_subs_epi16(a, b); }
  static V max(V a, V b) { return _mm_max_epi16(a, b); }
  static V add_unsigned(V a, V b) { return _mm_adds_epu16(a, b); }
  static V from_number(std::int32_t k) {
    return _mm_add_epi16(set1(static_cast<std::int16_t>(k)), _mm_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7));
  }

  static constexpr int kFours = 2;
  using Four = Sse42Fours;
  struct Fours {
    V x, y, z, entry;
  };
  static const __m128i* halves(const NearCluster& cluster) {
    return reinterpret_cast<const __m128i*>(&cluster);
  }
  static Fours fours(const NearCluster* from, const std::int16_t* number) {
    const __m128i* const first = halves(from[number[0]]);
    const __m128i* const second = halves(from[number[1]]);
    const V xy = _mm_load_si128(first), ze = _mm_load_si128(first + 1);
    const V other_xy = _mm_load_si128(second), other_ze = _mm_load_si128(second + 1);
    return {_mm_unpacklo_epi64(xy, other_xy), _mm_unpackhi_epi64(xy, other_xy),
            _mm_unpacklo_epi64(ze, other_ze), _mm_unpackhi_epi64(ze, other_ze)};
  }
  static V bits_where_below(V sum, V limit, int slot) {
    const V beyond = _mm_cmpeq_epi16(_mm_subs_epu16(limit, sum), _mm_setzero_si128());
    return _mm_andnot_si128(beyond, _mm_set1_epi64x(bits_of_slot(slot)));
  }
  static V either(V a, V b) { return _mm_or_si128(a, b); }
  static V pairs(std::uint16_t mask) {
    return _mm_set1_epi64x(~kMasks | static_cast<long long>(std::uint64_t{mask} << 32));
  }
  static V keep_pairs(V entries, V near, V pairs) {
    const V of_two = either(near, _mm_srli_epi64(near, 32)), all = either(of_two, _mm_srli_epi64(of_two, 16));
    const V others = _mm_set1_epi64x(~kMasks);
    return _mm_and_si128(_mm_and_si128(entries, pairs), either(_mm_slli_epi64(all, 32), others));
  }
  static V load_entries(const ClusterPairs::Entry* from) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
  }
  static std::uint32_t with_bits(V entries, long long bits) {
    const V none = _mm_cmpeq_epi64(_mm_and_si128(entries, _mm_set1_epi64x(bits)), _mm_setzero_si128());
    return static_cast<std::uint32_t>(_mm_movemask_pd(_mm_castsi128_pd(none))) ^ 3u;
  }
  static std::int32_t append(std::uint32_t lanes, V entries, ClusterPairs::Entry* to) {
    const V order = _mm_load_si128(reinterpret_cast<const __m128i*>(kPack64.bytes[lanes]));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_shuffle_epi8(entries, order));
    return __builtin_popcount(lanes);
  }
  static void copy_moved(const NearCluster& from, const ClusterMove& move, NearCluster& to) {
    for (int half = 0; half < 2; ++half) {
      const auto part = [&](int k) {
        return _mm_load_si128(reinterpret_cast<const __m128i*>(move.part[k]) + half);
      };
      const V moved = adds(adds(_mm_load_si128(halves(from) + half), part(0)), part(1));
      _mm_store_si128(reinterpret_cast<__m128i*>(&to) + half, moved);
    }
  }
};

}  // namespace

const ClusterSearchKernels& cluster_search_kernels_sse42() {
  static constexpr ClusterSearchKernels kKernels{
      keep_near<Sse42Fours>,       find_row<Sse42Fours>, refresh_clusters<Sse42Fours>,
      follow_clusters<Sse42Fours>, join<PlainMasks>,     split<Sse42Fours>};
  return kKernels;
}

}  // namespace dch::detail
