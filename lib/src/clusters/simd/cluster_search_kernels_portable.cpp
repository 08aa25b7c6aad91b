// SPDX-License-Identifier: MIT
#include "clusters/simd/cluster_search_kernels_sets.hpp"
#include "clusters/simd/join_loops.hpp"
#include "clusters/simd/near_loops.hpp"
#include "clusters/simd/refresh_loops.hpp"
#include "clusters/simd/vectors_portable.hpp"
#include "simd/lanes_portable.hpp"

namespace dch::detail {
namespace {

/// One box, and one cluster, at a time.
struct PortableFours : Portable {
  static V subs(V a, V b) { return saturated(a - b); }
  static V max(V a, V b) { return a > b ? a : b; }
  static V from_number(std::int32_t k) { return static_cast<V>(k); }

  static constexpr int kFours = 1;
  struct Four {
    struct V {
      std::int16_t slot[4];
    };
    template <class F>
    static V each(const F& f) {
      return {{f(0), f(1), f(2), f(3)}};
    }
    static V set1(std::int16_t v) { return {{v, v, v, v}}; }
    static V load(const std::int16_t* p) { return {{p[0], p[1], p[2], p[3]}}; }
    static V subs(V a, V b) {
      return each([&](int k) { return PortableFours::subs(a.slot[k], b.slot[k]); });
    }
    static V square(V a) {
      return each([&](int k) { return Portable::square(a.slot[k]); });
    }
    static V add_unsigned(V a, V b) {
      return each([&](int k) {
        const int sum = static_cast<std::uint16_t>(a.slot[k]) + static_cast<std::uint16_t>(b.slot[k]);
        return static_cast<std::int16_t>(static_cast<std::uint16_t>(sum > 0xFFFF ? 0xFFFF : sum));
      });
    }
    static V bits_where_below(V sum, V limit, int slot) {
      return each([&](int k) {
        const std::uint32_t is_below = bits_below(sum.slot[k], limit.slot[k]);
        return static_cast<std::int16_t>(static_cast<std::uint16_t>(is_below << (4 * slot + k)));
      });
    }
    static V either(V a, V b) {
      return each([&](int k) { return static_cast<std::int16_t>(a.slot[k] | b.slot[k]); });
    }
  };
  struct Fours {
    Four::V x, y, z;
    ClusterPairs::Entry entry;
  };
  static Fours fours(const NearCluster* from, const std::int16_t* number) {
    const NearCluster& cluster = from[*number];
    return {Four::load(cluster.x), Four::load(cluster.y), Four::load(cluster.z), cluster.entry};
  }
  static std::uint16_t pairs(std::uint16_t mask) { return mask; }
  static ClusterPairs::Entry keep_pairs(ClusterPairs::Entry entry, Four::V near, std::uint16_t pairs) {
    const int all = near.slot[0] | near.slot[1] | near.slot[2] | near.slot[3];
    entry.mask = static_cast<std::uint16_t>(entry.mask & pairs & all);
    return entry;
  }
  static ClusterPairs::Entry load_entries(const ClusterPairs::Entry* from) { return *from; }
  static std::uint32_t with_bits(ClusterPairs::Entry entry, long long bits) {
    return (entry.mask & static_cast<std::uint64_t>(bits) >> 32) != 0 ? 1 : 0;
  }
  static std::int32_t append(std::uint32_t is_near, ClusterPairs::Entry entry, ClusterPairs::Entry* to) {
    *to = entry;
    return static_cast<std::int32_t>(is_near);
  }
  static void copy_moved(const NearCluster& from, const ClusterMove& move, NearCluster& to) {
    const auto moved = [&](const std::int16_t* axis, int first) {
      return Four::each(
          [&](int k) { return adds(adds(axis[k], move.part[0][first + k]), move.part[1][first + k]); });
    };
    const Four::V x = moved(from.x, 0), y = moved(from.y, 4), z = moved(from.z, 8);
    for (int k = 0; k < 4; ++k) {
      to.x[k] = x.slot[k];
      to.y[k] = y.slot[k];
      to.z[k] = z.slot[k];
    }
    to.entry = from.entry;
    to.entry.shift = static_cast<std::uint16_t>(to.entry.shift + move.part[0][15]);
  }
};

}  // namespace

const ClusterSearchKernels& cluster_search_kernels_portable() {
  static constexpr ClusterSearchKernels kKernels{
      keep_near<PortableFours>,       find_row<PortableFours>, refresh_clusters<PortableFours>,
      follow_clusters<PortableFours>, join<PlainMasks>,        split<PortableFours>};
  return kKernels;
}

}  // namespace dch::detail
