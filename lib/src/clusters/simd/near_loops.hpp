// SPDX-License-Identifier: MIT
//
// The loops that find boxes and clusters near each other, over a type `S` of 16-bit lanes (see
// list_kernels_loops.hpp for the rules) with what is said of fours: the slots of S::kFours clusters in one
// S::Four::V for each coordinate.
#pragma once

#include "clusters/simd/cluster_search_kernels.hpp"

namespace dch::detail {
namespace {

/// Boxes whose numbers are found before anything is done with them.
inline constexpr std::int32_t kBoxesInTurn = 512;

/// The pairs of a row's cluster, which are in any entry of it, from the mask of the cluster's own entry.
inline std::uint16_t pairs_of_row(std::uint32_t mask) {
  const std::uint32_t first = (mask & 1) | (mask & 2) << 3 | (mask & 4) << 6 | (mask & 8) << 9;
  return static_cast<std::uint16_t>(15 * first);
}

/// Of an entry, its mask.
inline constexpr long long kMasks = 0x0000FFFF00000000LL;

/// Bits 4 a + b for slot a of a row's cluster, in lane b of the four that stand side by side.
inline long long bits_of_slot(int a) { return static_cast<long long>(0x0008000400020001ULL << (4 * a)); }

template <class S>
struct BoxTest {
  using V = typename S::V;
  BoxTest(const NearClusters& clusters, const ClusterBox& box, std::int16_t most)
      : from(clusters), limit(S::set1(most)) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = S::set1(box.side[axis]);
      high[axis] = S::set1(box.side[axis + 3]);
    }
  }
  V gap2(std::int32_t k, int axis) const {
    const V above = S::subs(S::load(from.side[axis] + k), high[axis]);
    const V below = S::subs(low[axis], S::load(from.side[axis + 3] + k));
    return S::square(S::max(S::max(above, below), S::set1(0)));
  }
  /// Lanes of the boxes near this one, from box k on, up to the last one's next.
  std::uint32_t operator()(std::int32_t k, std::int32_t last) const {
    const V t = S::adds(S::adds(gap2(k, 0), gap2(k, 1)), gap2(k, 2));
    const std::uint32_t lanes = S::bits_greater(limit, t) & S::kAll;
    return last - k < S::kLanes ? lanes & static_cast<std::uint32_t>((1ull << (last - k)) - 1) : lanes;
  }
  NearClusters from;
  V limit, low[3], high[3];
};

template <class S>
std::int32_t keep_near(const NearClusters& from, std::int32_t count, const ClusterBox& box,
                       std::int16_t limit, const ClusterMove& move, const NearClustersTo& to) {
  using V = typename S::V;
  const BoxTest<S> is_near(from, box, limit);
  V by[3][2];
  for (int axis = 0; axis < 3; ++axis)
    for (int part = 0; part < 2; ++part) by[axis][part] = S::set1(move.part[part][4 * axis]);
  std::int32_t kept = 0;
  std::int16_t number[kBoxesInTurn + kBoxesAtOnce];
  for (std::int32_t first = 0; first < count; first += kBoxesInTurn) {
    const std::int32_t last = count - first < kBoxesInTurn ? count : first + kBoxesInTurn;
    std::int32_t found = 0;
    for (std::int32_t k = first; k < last; k += S::kLanes) {
      const std::uint32_t lanes = is_near(k, last);
      for (int side = 0; side < 6; ++side) {
        const V moved = S::adds(S::adds(S::load(from.side[side] + k), by[side % 3][0]), by[side % 3][1]);
        S::move_to_front(lanes, moved, to.side[side] + kept + found);
      }
      S::move_to_front(lanes, S::from_number(k - first), number + found);
      found += __builtin_popcount(lanes);
    }
    for (std::int32_t n = 0; n < found; ++n)
      S::copy_moved(from.cluster[first + number[n]], move, to.cluster[kept + n]);
    kept += found;
  }
  return kept;
}

/// The slots of the row's cluster, each beside all lanes.
template <class S>
struct SlotsOfRow {
  using Four = typename S::Four;
  explicit SlotsOfRow(const NearCluster& cluster) {
    for (int slot = 0; slot < 4; ++slot) {
      x[slot] = Four::set1(cluster.x[slot]);
      y[slot] = Four::set1(cluster.y[slot]);
      z[slot] = Four::set1(cluster.z[slot]);
    }
  }
  /// Of each slot of other clusters bits 4 a + b of the pairs with slots a of this one whose sum of squares
  /// is less than a limit, in the lane of slot b.
  typename Four::V pairs_below(const typename S::Fours& j, typename Four::V limit) const {
    typename Four::V near{};
    for (int slot = 0; slot < 4; ++slot) {
      const auto sum = Four::add_unsigned(
          Four::add_unsigned(Four::square(Four::subs(j.x, x[slot])), Four::square(Four::subs(j.y, y[slot]))),
          Four::square(Four::subs(j.z, z[slot])));
      const auto of_slot = Four::bits_where_below(sum, limit, slot);
      near = slot == 0 ? of_slot : Four::either(near, of_slot);
    }
    return near;
  }
  typename Four::V x[4], y[4], z[4];
};

template <class S>
FoundRow find_row(const RowCluster& row, const NearClusters& from, std::int32_t count, std::int16_t limit,
                  ClusterPairs::Entry* to) {
  const BoxTest<S> is_near(from, row.box, limit);
  const SlotsOfRow<S> slots(row.cluster);
  const auto most = S::Four::set1(limit);
  const auto pairs = S::pairs(pairs_of_row(row.cluster.entry.mask));
  FoundRow all;
  std::int16_t number[kBoxesInTurn + kBoxesAtOnce];
  for (std::int32_t first = 0; first < count; first += kBoxesInTurn) {
    const std::int32_t last = count - first < kBoxesInTurn ? count : first + kBoxesInTurn;
    std::int32_t found = 0;
    for (std::int32_t k = first; k < last; k += S::kLanes) {
      const std::uint32_t lanes = is_near(k, last);
      S::move_to_front(lanes, S::from_number(k - first), number + found);
      found += __builtin_popcount(lanes);
    }
    for (int more = 0; more < S::kFours; ++more) number[found + more] = 0;
    for (std::int32_t n = 0; n < found; n += S::kFours) {
      const auto j = S::fours(from.cluster + first, number + n);
      const auto entries = S::keep_pairs(j.entry, slots.pairs_below(j, most), pairs);
      const std::int32_t left = found - n < S::kFours ? found - n : S::kFours;  // no branch: hard to foretell
      const std::uint32_t near = S::with_bits(entries, kMasks) & ((1u << left) - 1);
      all.entries += S::append(near, entries, to + all.entries);
    }
    all.compared += found;
  }
  return all;
}

}  // namespace
}  // namespace dch::detail
