// SPDX-License-Identifier: MIT
//
// Masks hold the pairs that are near, and entries in another order lose none, in every kind of box.
#include <algorithm>
#include <gtest/gtest.h>
#include <tuple>
#include <vector>

#include <dch/base/executor.hpp>

#include "instruction_sets.hpp"
#include "ordered_pairs.hpp"

namespace dch {
namespace {

using scenes::EntryOrder, scenes::kRefreshes;

class OrderedEntries : public scenes::OrderedPairs {};

using NamedEntry = std::tuple<std::int32_t, std::int32_t, int>;  ///< cluster, shift, mask

/// The entries of each cluster, ascending, of whichever rows.
std::vector<std::vector<NamedEntry>> entries_by_cluster(const ClusterPairs& pairs) {
  std::vector<std::vector<NamedEntry>> all(static_cast<std::size_t>(pairs.clusters()));
  for (std::size_t r = 0; r + 1 < pairs.rows.size(); ++r)
    for (std::int64_t e = pairs.rows[r].first; e < pairs.rows[r + 1].first; ++e) {
      const ClusterPairs::Entry& entry = pairs.entries[static_cast<std::size_t>(e)];
      all[static_cast<std::size_t>(pairs.rows[r].cluster)].emplace_back(
          entry.cluster, pairs.rows[r].first_shift + entry.shift, entry.mask);
    }
  for (auto& row : all) std::sort(row.begin(), row.end());
  return all;
}

/// Bits of the pairs of an entry that are within a distance, from positions in double precision.
std::uint32_t near_bits(const ClusterPairs& pairs, const ClusterPairs::Row& row,
                        const ClusterPairs::Entry& entry, double distance) {
  const auto& i = pairs.at[static_cast<std::size_t>(row.cluster)];
  const auto& j = pairs.at[static_cast<std::size_t>(entry.cluster)];
  const auto& by = pairs.shift_vector[static_cast<std::size_t>(row.first_shift) + entry.shift].whole;
  std::uint32_t bits = 0;
  for (int bit = 0; bit < 16; ++bit) {
    const int a = bit / 4, b = bit % 4;
    const Vec3 apart{j.x[b] + by.x[b] - i.x[a], j.y[b] + by.y[b] - i.y[a], j.z[b] + by.z[b] - i.z[a]};
    bits |= static_cast<std::uint32_t>(norm2(apart) <= distance * distance) << bit;
  }
  return bits;
}

/// Bits of the pairs of two slots with a particle, those of a cluster with itself once.
std::uint32_t bits_of_particles(const ClusterPairs& pairs, std::int32_t own, std::int32_t other) {
  std::uint32_t bits = 0;
  for (int bit = 0; bit < 16; ++bit) {
    const int a = bit / 4, b = bit % 4;
    const bool are_particles = pairs.particle[static_cast<std::size_t>(4 * own + a)] >= 0 &&
                               pairs.particle[static_cast<std::size_t>(4 * other + b)] >= 0;
    bits |= static_cast<std::uint32_t>(are_particles && (own != other || a < b)) << bit;
  }
  return bits;
}

/// Before and after motion, what is far apart would only be looked at in vain.
TEST_P(OrderedEntries, MasksHoldThePairsThatAreNear) {
  for (const InstructionSet set : supported_sets()) {
    const RestoreInstructionSet restore;
    set_instruction_set(set);
    ClusterPairs pairs = searched(0);
    pairs.refresh(points, box);
    const double radius = request.list_radius();
    for (std::size_t r = 0; r + 1 < pairs.rows.size(); ++r)
      for (std::int64_t e = pairs.rows[r].first; e < pairs.rows[r + 1].first; ++e) {
        const ClusterPairs::Entry& entry = pairs.entries[static_cast<std::size_t>(e)];
        const bool is_own_image =
            entry.cluster == pairs.rows[r].cluster &&
            pairs.shift[static_cast<std::size_t>(pairs.rows[r].first_shift) + entry.shift].image != Vec3{};
        const std::uint32_t all =
            is_own_image ? 0xFFFF : bits_of_particles(pairs, pairs.rows[r].cluster, entry.cluster);
        const std::uint32_t mask = entry.mask;
        ASSERT_NE(mask, 0u);
        ASSERT_EQ(near_bits(pairs, pairs.rows[r], entry, (1 - 1e-9) * radius) & all & ~mask, 0u);
        ASSERT_EQ(mask & ~near_bits(pairs, pairs.rows[r], entry, 1.01 * radius), 0u);
      }
  }
}

/// The images of a row's entries.
std::vector<Vec3> images_of_row(const ClusterPairs& pairs, std::size_t r) {
  std::vector<Vec3> images;
  for (std::int64_t e = pairs.rows[r].first; e < pairs.rows[r + 1].first; ++e) {
    const ClusterPairs::Entry& entry = pairs.entries[static_cast<std::size_t>(e)];
    images.push_back(pairs.shift[static_cast<std::size_t>(pairs.rows[r].first_shift) + entry.shift].image);
  }
  return images;
}

TEST_P(OrderedEntries, StandByHalvesOfTheirPairs) {
  const ClusterPairs before = searched(kRefreshes);
  for (const EntryOrder order : {EntryOrder::by_halves, EntryOrder::by_image_and_halves}) {
    const ClusterPairs pairs = ordered(order);
    ASSERT_EQ(pairs.entry_order, order);
    ASSERT_EQ(pairs.parts.size() + 1, pairs.rows.size());
    EXPECT_EQ(entries_by_cluster(pairs), entries_by_cluster(before));
    std::size_t halves = 0;
    for (std::size_t r = 0; r < pairs.parts.size(); ++r)
      for (std::int64_t e = pairs.rows[r].first; e < pairs.rows[r + 1].first; ++e) {
        const int mask = pairs.entries[static_cast<std::size_t>(e)].mask;
        const std::int64_t n = e - pairs.rows[r].first;
        ASSERT_EQ((mask & 0x00FF) != 0, n < pairs.parts[r].lower);
        ASSERT_EQ((mask & 0xFF00) != 0, n < pairs.parts[r].first || n >= pairs.parts[r].lower);
        halves += n >= pairs.parts[r].first ? 1 : 0;
      }
    EXPECT_GT(5 * halves, pairs.entries.size()) << "a fifth of all entries, at least";
  }
}

TEST_P(OrderedEntries, OfARowAreOfOneImageIfAskedFor) {
  for (const EntryOrder order : {EntryOrder::joined, EntryOrder::by_image_and_halves}) {
    const ClusterPairs pairs = ordered(order);
    for (std::size_t r = 0; r < pairs.parts.size(); ++r)
      for (const Vec3& image : images_of_row(pairs, r)) ASSERT_EQ(image, images_of_row(pairs, r).front());
  }
  EXPECT_EQ(ordered(EntryOrder::by_halves).rows.size(), searched(kRefreshes).rows.size());
}

TEST_P(OrderedEntries, StandTwoByTwoWithoutABitInCommon) {
  std::vector<std::vector<ClusterPairs::Entry>> by_set;
  for (const InstructionSet set : supported_sets()) {
    const RestoreInstructionSet restore;
    set_instruction_set(set);
    const ClusterPairs before = searched(kRefreshes), pairs = ordered(EntryOrder::joined);
    ASSERT_EQ(pairs.entry_order, EntryOrder::joined);
    ASSERT_EQ(pairs.parts.size() + 1, pairs.rows.size());
    EXPECT_EQ(entries_by_cluster(pairs), entries_by_cluster(before));
    std::size_t two_by_two = 0;
    for (std::size_t r = 0; r < pairs.parts.size(); ++r) {
      const ClusterPairs::Row& row = pairs.rows[r];
      ASSERT_LT(row.first, pairs.rows[r + 1].first);
      ASSERT_EQ((pairs.rows[r + 1].first - row.first - pairs.parts[r].first) % 2, 0);
      for (std::int64_t e = row.first + pairs.parts[r].first; e < pairs.rows[r + 1].first;
           e += 2, ++two_by_two)
        ASSERT_EQ(pairs.entries[static_cast<std::size_t>(e)].mask &
                      pairs.entries[static_cast<std::size_t>(e) + 1].mask,
                  0);
    }
    EXPECT_GT(4 * two_by_two, pairs.entries.size()) << "half of all entries, at least";
    by_set.push_back(pairs.entries);
  }
  for (const auto& entries : by_set)
    for (std::size_t e = 0; e < entries.size(); ++e) {
      ASSERT_EQ(entries[e].cluster, by_set.front()[e].cluster);
      ASSERT_EQ(entries[e].mask, by_set.front()[e].mask);
    }
}

TEST_P(OrderedEntries, AreTheSameOnAnyNumberOfThreads) {
  for (const EntryOrder order : scenes::kOrders) {
    const ClusterPairs alone = ordered(order);
    for (const int threads : {2, 5}) {
      const auto pool = make_thread_pool(threads);
      const ClusterPairs together = ordered(order, pool.get());
      ASSERT_EQ(together.rows.size(), alone.rows.size());
      for (std::size_t r = 0; r < alone.parts.size(); ++r) {
        ASSERT_EQ(together.rows[r].first, alone.rows[r].first);
        ASSERT_EQ(together.rows[r].cluster, alone.rows[r].cluster);
        ASSERT_EQ(together.parts[r].first, alone.parts[r].first);
        ASSERT_EQ(together.parts[r].lower, alone.parts[r].lower);
      }
      ASSERT_EQ(together.entries.size(), alone.entries.size());
      for (std::size_t e = 0; e < alone.entries.size(); ++e) {
        ASSERT_EQ(together.entries[e].cluster, alone.entries[e].cluster);
        ASSERT_EQ(together.entries[e].mask, alone.entries[e].mask);
      }
    }
  }
}

TEST_P(OrderedEntries, AreMadeWhereListsLiveSomeSteps) {
  for (const EntryOrder order : scenes::kOrders) {
    ClusterPairs pairs = searched(ClusterPairs::steps_to_order(order) - 1);
    pairs.order_entries(order);
    EXPECT_EQ(pairs.entry_order, EntryOrder::as_found);
  }
  ClusterPairs pairs = ordered(EntryOrder::by_halves);
  pairs.order_entries(EntryOrder::joined);
  EXPECT_EQ(pairs.entry_order, EntryOrder::by_halves) << "they have an order already";
  pairs = ordered(EntryOrder::as_found);
  EXPECT_TRUE(pairs.parts.empty());
  ClusterPairs of_none;
  of_none.refreshes_before = kRefreshes;
  of_none.order_entries(EntryOrder::joined);
  EXPECT_EQ(of_none.entry_order, EntryOrder::as_found);
}

INSTANTIATE_TEST_SUITE_P(Boxes, OrderedEntries, ::testing::ValuesIn(scenes::all_boxes(10.0)),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace dch
