// SPDX-License-Identifier: MIT
//
// The loops that tell how entries stand best: two by two, over a type `S` of kJoinedAtOnce masks, or by
// halves, over one as near_loops.hpp has them; see cluster_loops.hpp.
#pragma once

#include "clusters/simd/cluster_search_kernels.hpp"

namespace dch::detail {
namespace {

/// Masks with at least so many bits come before those with fewer. With sixteen classes in place of three a
/// register holds 1 in 50 pairs more; to find the classes takes longer than that.
inline constexpr int kLeastBits[] = {9, 6, 0};

/// In memory, for sets whose registers hold fewer.
struct PlainMasks {
  struct Masks {
    std::uint16_t mask[kJoinedAtOnce];
  };
  static Masks of(const ClusterPairs::Entry* entries, std::int32_t count) {
    Masks masks{};
    for (std::int32_t n = 0; n < count; ++n) masks.mask[n] = entries[n].mask;
    return masks;
  }
  static Masks load(const std::uint16_t* mask) {
    Masks masks;
    for (int n = 0; n < kJoinedAtOnce; ++n) masks.mask[n] = mask[n];
    return masks;
  }
  static std::uint32_t with_bits(const Masks& masks, int least) {
    std::uint32_t lanes = 0;
    for (int n = 0; n < kJoinedAtOnce; ++n)
      lanes |= static_cast<std::uint32_t>(__builtin_popcount(masks.mask[n]) >= least) << n;
    return lanes;
  }
  static void move_to_front(std::uint32_t lanes, const Masks& masks, std::uint16_t* to,
                            std::uint16_t* number) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      *to++ = masks.mask[lane];
      *number++ = static_cast<std::uint16_t>(lane);
    }
  }
  static std::uint32_t without_bits_of(std::uint16_t one, const Masks& masks) {
    std::uint32_t lanes = 0;
    for (int n = 0; n < kJoinedAtOnce; ++n)
      lanes |= static_cast<std::uint32_t>((masks.mask[n] & one) == 0) << n;
    return lanes;
  }
};

/// See ClusterSearchKernels::join. What fits an entry is found for all of them before any is taken, so only
/// bits of a number wait for each other; and nothing branches that is hard to foretell.
template <class S>
JoinedEntries join(const ClusterPairs::Entry* entries, std::int32_t count, const JoinedEntriesTo& to) {
  ClusterPairs::Entry from[kJoinedAtOnce];
  __builtin_memcpy(from, entries, sizeof from[0] * static_cast<std::size_t>(count));
  std::uint16_t sorted[2 * kJoinedAtOnce]{}, number[2 * kJoinedAtOnce]{};
  const typename S::Masks given = S::of(from, count);
  const auto each = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
  std::int32_t found = 0;
  std::uint32_t before = 0;
  for (const int least : kLeastBits) {
    const std::uint32_t lanes = S::with_bits(given, least) & each;
    S::move_to_front(lanes & ~before, given, sorted + found, number + found);
    found += __builtin_popcount(lanes & ~before);
    before = lanes;
  }
  const typename S::Masks all = S::load(sorted);
  std::uint32_t fits[kJoinedAtOnce];
  for (std::int32_t n = 0; n < count; ++n) fits[n] = S::without_bits_of(sorted[n], all);
  ClusterPairs::Entry alone[kJoinedAtOnce];
  JoinedEntries result;
  std::uint32_t left = each;
  while (left != 0) {
    const int first = __builtin_ctz(left);
    left &= left - 1;
    const std::uint32_t others = fits[first] & left;
    const std::uint32_t other = others & (0 - others);
    left &= ~other;
    const int second = __builtin_ctz(other | 0x80000000U);  // any, if there is none
    alone[result.alone] = to.joined[result.joined] = from[number[first]];
    to.joined[result.joined + 1] = from[number[second]];
    result.alone += other == 0 ? 1 : 0;
    result.joined += other == 0 ? 0 : 2;
  }
  __builtin_memcpy(to.alone, alone, sizeof alone[0] * static_cast<std::size_t>(result.alone));
  return result;
}

/// See ClusterSearchKernels::split.
template <class S>
EntryHalves split(const ClusterPairs::Entry* entries, std::int32_t count, const EntryHalvesTo& to) {
  constexpr long long kLowerBits = 0x000000FF00000000LL, kUpperBits = 0x0000FF0000000000LL;
  EntryHalves found;
  const auto add = [&](const ClusterPairs::Entry* from, std::uint32_t lanes) {
    const auto some = S::load_entries(from);
    const std::uint32_t lower = S::with_bits(some, kLowerBits), upper = S::with_bits(some, kUpperBits);
    found.both += S::append(lower & upper, some, to.both + found.both);
    found.lower += S::append(lower & ~upper, some, to.lower + found.lower);
    found.upper += S::append(~lower & lanes, some, to.upper + found.upper);
  };
  std::int32_t n = 0;
  constexpr std::uint32_t kAll = (1u << S::kFours) - 1;
  for (; n + S::kFours <= count; n += S::kFours) add(entries + n, kAll);
  ClusterPairs::Entry last[S::kFours]{};
  for (std::int32_t k = n; k < count; ++k) last[k - n] = entries[k];
  add(last, (1u << (count - n)) - 1);
  return found;
}

}  // namespace
}  // namespace dch::detail
