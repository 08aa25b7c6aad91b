// SPDX-License-Identifier: MIT
//
// Every instruction set finds the clusters that the definitions in cluster_search_kernels.hpp say, saturation
// included.
#include "clusters/simd/cluster_search_kernels.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <tuple>
#include <vector>

#include "base/aligned_vector.hpp"
#include "instruction_sets.hpp"
#include "scenes.hpp"

namespace dch::detail {
namespace {

constexpr int kClusterTrials = 200;
constexpr std::size_t kClusterCounts[] = {0, 1, 3, 4, 5, 15, 16, 17, 31, 33, 60, 511, 512, 513, 1100};

std::int16_t to_16_bits(int v) { return static_cast<std::int16_t>(std::clamp(v, -32768, 32767)); }
int rounded_square(int d) { return (d * d + 0x4000) >> 15; }

/// Random clusters with room for what kernels read and write beyond.
struct RandomClusters {
  explicit RandomClusters(std::size_t count) : cluster(count + 1), side() {
    for (auto& numbers : side) numbers.resize(count + kBoxesAtOnce);
  }
  RandomClusters(std::size_t count, int most, int width, scenes::Random& random) : RandomClusters(count) {
    const auto number = [&](int up_to) {
      return static_cast<int>(random.below(2 * static_cast<std::size_t>(up_to) + 1)) - up_to;
    };
    for (std::size_t k = 0; k < count; ++k) {
      NearCluster& at = cluster[k];
      std::int16_t* const axes[] = {at.x, at.y, at.z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int middle = number(most);
        for (int slot = 0; slot < 4; ++slot) axes[axis][slot] = to_16_bits(middle + number(width));
        side[axis][k] = *std::min_element(axes[axis], axes[axis] + 4);
        side[axis + 3][k] = *std::max_element(axes[axis], axes[axis] + 4);
      }
      const std::uint32_t filled = (1u << (1 + random.below(4))) - 1;
      at.entry = {static_cast<std::int32_t>(random.below(1000000)),
                  static_cast<std::uint16_t>(0x1111 * filled), 0};
    }
  }
  NearClusters from() const {
    NearClusters clusters{cluster.data(), {}};
    for (std::size_t s = 0; s < side.size(); ++s) clusters.side[s] = side[s].data();
    return clusters;
  }
  NearClustersTo to() {
    NearClustersTo clusters{cluster.data(), {}};
    for (std::size_t s = 0; s < side.size(); ++s) clusters.side[s] = side[s].data();
    return clusters;
  }
  ClusterBox box(std::size_t k) const {
    ClusterBox box{};
    for (std::size_t s = 0; s < side.size(); ++s) box.side[s] = side[s][k];
    return box;
  }
  AlignedVector<NearCluster> cluster;
  std::array<AlignedVector<std::int16_t>, 6> side;
};

int gap2_of_boxes(const ClusterBox& a, const ClusterBox& b) {
  int sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int above = to_16_bits(a.side[axis] - b.side[axis + 3]);
    const int below = to_16_bits(b.side[axis] - a.side[axis + 3]);
    sum += rounded_square(std::max({above, below, 0}));
  }
  return sum;
}

/// Bits 4 a + b of slots a and b that are near each other.
std::uint32_t bits_of_near_slots(const NearCluster& a, const NearCluster& b, std::int16_t limit) {
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const int sum = rounded_square(to_16_bits(b.x[j] - a.x[i])) +
                      rounded_square(to_16_bits(b.y[j] - a.y[i])) +
                      rounded_square(to_16_bits(b.z[j] - a.z[i]));
      bits |= static_cast<std::uint32_t>(sum < limit) << (4 * i + j);
    }
  return bits;
}

bool same_entry(const ClusterPairs::Entry& a, const ClusterPairs::Entry& b) {
  return a.cluster == b.cluster && a.mask == b.mask && a.shift == b.shift;
}

class ClusterSearchKernelsTest : public ::testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this processor has no " << name(GetParam());
  }
  const ClusterSearchKernels& kernels() const { return cluster_search_kernels(GetParam()); }
  /// Calls f(clusters, count, random) for clusters as wide apart as any.
  template <class F>
  static void for_random_clusters(const F& f) {
    scenes::Random random(31);
    for (int set = 0; set < kClusterTrials; ++set)
      for (const std::size_t count : kClusterCounts) {
        if (count > 60 && set % 20 != 0) continue;
        const int most = std::array{300, 3000, 16000, 32768}[static_cast<std::size_t>(set % 4)];
        f(RandomClusters(count, most, set % 3 == 0 ? most : most / 8, random), count, random);
      }
  }
  static std::int16_t random_limit(scenes::Random& random) {
    return static_cast<std::int16_t>(1 + random.below(random.below(2) == 0 ? 32767 : 200));
  }
};

TEST_P(ClusterSearchKernelsTest, KeepWhatIsNearABoxInAnotherFrame) {
  for_random_clusters([&](const RandomClusters& clusters, std::size_t count, scenes::Random& random) {
    ClusterMove move{};
    for (int axis = 0; axis < 3; ++axis) {
      const int sign = random.below(2) == 0 ? 1 : -1, most = random.below(2) == 0 ? 300 : 32768;
      for (auto& part : move.part)
        std::fill_n(
            part + 4 * axis, 4,
            static_cast<std::int16_t>(sign * static_cast<int>(random.below(static_cast<std::size_t>(most)))));
    }
    move.part[0][15] = static_cast<std::int16_t>(static_cast<std::uint16_t>(random.below(65536)));
    const ClusterBox box = RandomClusters(1, 16000, 4000, random).box(0);
    const std::int16_t limit = random_limit(random);
    RandomClusters to(count);
    const auto kept = static_cast<std::size_t>(
        kernels().keep_near(clusters.from(), static_cast<std::int32_t>(count), box, limit, move, to.to()));
    const auto moved = [&](int v, int lane) {
      return to_16_bits(to_16_bits(v + move.part[0][lane]) + move.part[1][lane]);
    };
    std::size_t expected = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (gap2_of_boxes(clusters.box(k), box) >= limit) continue;
      const NearCluster &from = clusters.cluster[k], &copy = to.cluster[expected];
      ASSERT_LT(expected, kept);
      for (int slot = 0; slot < 4; ++slot) {
        ASSERT_EQ(copy.x[slot], moved(from.x[slot], 0));
        ASSERT_EQ(copy.y[slot], moved(from.y[slot], 4));
        ASSERT_EQ(copy.z[slot], moved(from.z[slot], 8));
      }
      ASSERT_TRUE(same_entry(
          copy.entry, {from.entry.cluster, from.entry.mask, static_cast<std::uint16_t>(move.part[0][15])}));
      for (int side = 0; side < 6; ++side)
        ASSERT_EQ(to.box(expected).side[side], moved(clusters.box(k).side[side], 4 * (side % 3)));
      ++expected;
    }
    ASSERT_EQ(kept, expected) << count;
  });
}

TEST_P(ClusterSearchKernelsTest, FindThePairsOfSlotsThatAreNear) {
  for_random_clusters([&](const RandomClusters& clusters, std::size_t count, scenes::Random& random) {
    const RandomClusters own(1, 16000, 2000, random);
    const std::int16_t limit = random_limit(random);
    std::vector<ClusterPairs::Entry> entries(count + kEntriesAtOnce);
    const FoundRow found = kernels().find_row({own.cluster[0], own.box(0)}, clusters.from(),
                                              static_cast<std::int32_t>(count), limit, entries.data());
    std::int32_t expected = 0, compared = 0;
    for (std::size_t k = 0; k < count; ++k) {
      compared += gap2_of_boxes(clusters.box(k), own.box(0)) < limit;
      const ClusterPairs::Entry& entry = clusters.cluster[k].entry;
      std::uint32_t mask = 0;
      for (int a = 0; a < 4; ++a)
        if ((own.cluster[0].entry.mask >> a & 1) != 0) mask |= 15u << (4 * a);
      mask &= entry.mask & bits_of_near_slots(own.cluster[0], clusters.cluster[k], limit);
      if (mask == 0) continue;
      ASSERT_LT(expected, found.entries);
      ASSERT_TRUE(same_entry(entries[static_cast<std::size_t>(expected)],
                             {entry.cluster, static_cast<std::uint16_t>(mask), entry.shift}));
      ++expected;
    }
    ASSERT_EQ(found.entries, expected) << count;
    ASSERT_EQ(found.compared, compared) << count;
  });
}

/// Calls f(entries, count) for entries of masks of few bits, of more, and of any.
template <class F>
void for_random_entries(const F& f) {
  scenes::Random random(7);
  for (int trial = 0; trial < 3000; ++trial) {
    const auto count = static_cast<std::int32_t>(1 + random.below(kJoinedAtOnce));
    const std::size_t most = std::array<std::size_t, 3>{3, 8, 16}[static_cast<std::size_t>(trial % 3)];
    std::vector<ClusterPairs::Entry> entries(static_cast<std::size_t>(count));
    for (ClusterPairs::Entry& entry : entries) {
      entry = {static_cast<std::int32_t>(random.below(1000)), 0,
               static_cast<std::uint16_t>(random.below(65536))};
      for (std::size_t bits = random.below(most + 1); bits > 0; --bits)
        entry.mask = static_cast<std::uint16_t>(entry.mask | 1u << random.below(16));
    }
    f(entries, count);
  }
}

TEST_P(ClusterSearchKernelsTest, JoinEntriesWithoutABitInCommon) {
  using Entries = std::vector<ClusterPairs::Entry>;
  const auto joined_by = [](const ClusterSearchKernels& set, const Entries& entries, bool in_place) {
    Entries alone = in_place ? entries : Entries(entries.size()), joined(entries.size() + 2);
    const JoinedEntries found =
        set.join(in_place ? alone.data() : entries.data(), static_cast<std::int32_t>(entries.size()),
                 {alone.data(), joined.data()});
    alone.resize(static_cast<std::size_t>(found.alone));
    joined.resize(static_cast<std::size_t>(found.joined));
    return std::array<Entries, 2>{alone, joined};
  };
  const auto by_names = [](const ClusterPairs::Entry& a, const ClusterPairs::Entry& b) {
    return std::tie(a.cluster, a.mask, a.shift) < std::tie(b.cluster, b.mask, b.shift);
  };
  for_random_entries([&](const Entries& entries, std::int32_t) {
    const auto found = joined_by(kernels(), entries, false);
    for (const auto& other : {joined_by(kernels(), entries, true),
                              joined_by(cluster_search_kernels(InstructionSet::portable), entries, false)})
      for (std::size_t part = 0; part < 2; ++part)
        ASSERT_TRUE(std::equal(found[part].begin(), found[part].end(), other[part].begin(), other[part].end(),
                               same_entry));
    const auto& [alone, joined] = found;
    for (std::size_t n = 0; n < alone.size(); ++n)
      for (std::size_t other = 0; other < n; ++other)
        ASSERT_NE(alone[n].mask & alone[other].mask, 0) << "two that fit stand alone";
    ASSERT_EQ(joined.size() % 2, 0u);
    for (std::size_t n = 0; n < joined.size(); n += 2) ASSERT_EQ(joined[n].mask & joined[n + 1].mask, 0);
    Entries all = alone, expected = entries;
    all.insert(all.end(), joined.begin(), joined.end());
    std::sort(all.begin(), all.end(), by_names);
    std::sort(expected.begin(), expected.end(), by_names);
    ASSERT_TRUE(std::equal(all.begin(), all.end(), expected.begin(), expected.end(), same_entry));
  });
}

TEST_P(ClusterSearchKernelsTest, SplitEntriesByHalves) {
  for_random_entries([&](const std::vector<ClusterPairs::Entry>& entries, std::int32_t count) {
    std::array<std::vector<ClusterPairs::Entry>, 3> expected, to;
    for (const ClusterPairs::Entry& entry : entries)
      expected[(entry.mask & 0xFF) == 0 ? 2 : (entry.mask >> 8 == 0 ? 1 : 0)].push_back(entry);
    for (auto& part : to) part.resize(entries.size() + kEntriesAtOnce);
    const EntryHalves found =
        kernels().split(entries.data(), count, {to[0].data(), to[1].data(), to[2].data()});
    const std::array<std::int32_t, 3> counts{found.both, found.lower, found.upper};
    for (std::size_t part = 0; part < 3; ++part) {
      ASSERT_EQ(static_cast<std::size_t>(counts[part]), expected[part].size());
      for (std::size_t n = 0; n < expected[part].size(); ++n)
        ASSERT_TRUE(same_entry(to[part][n], expected[part][n]));
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Sets, ClusterSearchKernelsTest, ::testing::ValuesIn(kInstructionSets),
                         [](const auto& p) {
                           std::string text = name(p.param);
                           text.erase(std::remove(text.begin(), text.end(), '.'), text.end());
                           return text;
                         });

}  // namespace
}  // namespace dch::detail
