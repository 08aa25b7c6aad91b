// SPDX-License-Identifier: MIT
#include "clusters/simd/cluster_search_kernels_sets.hpp"
#include "clusters/simd/join_loops.hpp"
#include "clusters/simd/near_loops.hpp"
#include "clusters/simd/refresh_loops.hpp"
#include "clusters/simd/vectors_neon.hpp"
#include "simd/lanes_neon.hpp"

namespace dch::detail {
namespace {

constexpr PackBytes<2, 8> kPack64;

/// Two clusters in a register.
struct NeonFours : Neon {
  static V subs(V a, V b) { return vqsubq_s16(a, b); }
  static V max(V a, V b) { return vmaxq_s16(a, b); }
  static V add_unsigned(V a, V b) { return with_sign(vqaddq_u16(no_sign(a), no_sign(b))); }
  static V from_number(std::int32_t k) {
    const V lane = {0, 1, 2, 3, 4, 5, 6, 7};
    return vaddq_s16(set1(static_cast<std::int16_t>(k)), lane);
  }

  static constexpr int kFours = 2;
  using Four = NeonFours;
  struct Fours {
    V x, y, z, entry;
  };
  /// The x and y of a cluster, then its z and its entry.
  struct Halves {
    int64x2_t half[2];
  };
  static Halves halves(const NearCluster& cluster) {
    Halves both;
    static_assert(sizeof both == sizeof cluster);
    __builtin_memcpy(&both, &cluster, sizeof both);
    return both;
  }
  static Fours fours(const NearCluster* from, const std::int16_t* number) {
    const Halves first = halves(from[number[0]]), second = halves(from[number[1]]);
    const auto lower = [&](int k) {
      return vreinterpretq_s16_s64(vzip1q_s64(first.half[k], second.half[k]));
    };
    const auto upper = [&](int k) {
      return vreinterpretq_s16_s64(vzip2q_s64(first.half[k], second.half[k]));
    };
    return {lower(0), upper(0), lower(1), upper(1)};
  }
  static V bits_where_below(V sum, V limit, int slot) {
    const uint16x8_t bits = vreinterpretq_u16_s64(vdupq_n_s64(bits_of_slot(slot)));
    return with_sign(vandq_u16(vcltq_u16(no_sign(sum), no_sign(limit)), bits));
  }
  static V either(V a, V b) { return vorrq_s16(a, b); }
  static V pairs(std::uint16_t mask) {
    return vreinterpretq_s16_u64(
        vdupq_n_u64(static_cast<std::uint64_t>(~kMasks) | std::uint64_t{mask} << 32));
  }
  static V keep_pairs(V entries, V near, V pairs) {
    const uint64x2_t bits = vreinterpretq_u64_s16(near), of_two = vorrq_u64(bits, vshrq_n_u64(bits, 32));
    const uint64x2_t all = vorrq_u64(of_two, vshrq_n_u64(of_two, 16));
    const uint64x2_t kept = vorrq_u64(vshlq_n_u64(all, 32), vdupq_n_u64(static_cast<std::uint64_t>(~kMasks)));
    return vandq_s16(vandq_s16(entries, pairs), vreinterpretq_s16_u64(kept));
  }
  static V load_entries(const ClusterPairs::Entry* from) {
    V entries;
    __builtin_memcpy(&entries, from, sizeof entries);
    return entries;
  }
  static std::uint32_t with_bits(V entries, long long bits) {
    const uint64x2_t wanted = vdupq_n_u64(static_cast<std::uint64_t>(bits)), bit = {1, 2};
    const uint64x2_t any = vtstq_u64(vreinterpretq_u64_s16(entries), wanted);
    return static_cast<std::uint32_t>(vaddvq_u64(vandq_u64(any, bit)));
  }
  static std::int32_t append(std::uint32_t lanes, V entries, ClusterPairs::Entry* to) {
    const V front = packed16(entries, kPack64.bytes[lanes]);
    __builtin_memcpy(to, &front, sizeof front);
    return __builtin_popcount(lanes);
  }
  static void copy_moved(const NearCluster& from, const ClusterMove& move, NearCluster& to) {
    Halves moved = halves(from);
    for (int half = 0; half < 2; ++half) {
      const auto part = [&](int k) { return load(move.part[k] + 8 * half); };
      const V at = adds(adds(vreinterpretq_s16_s64(moved.half[half]), part(0)), part(1));
      moved.half[half] = vreinterpretq_s64_s16(at);
    }
    __builtin_memcpy(&to, &moved, sizeof moved);
  }
};

}  // namespace

const ClusterSearchKernels& cluster_search_kernels_neon() {
  static constexpr ClusterSearchKernels kKernels{
      keep_near<NeonFours>,       find_row<NeonFours>, refresh_clusters<NeonFours>,
      follow_clusters<NeonFours>, join<PlainMasks>,    split<NeonFours>};
  return kKernels;
}

}  // namespace dch::detail
