// SPDX-License-Identifier: MIT
//
// The engine that chooses: no pair is lost or invented while it changes between the grid and the hierarchy.
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "cluster_pair_check.hpp"
#include "list_compare.hpp"
#include "list_params.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kAutoRadius = 1.5, kAutoSide = 70;
constexpr std::size_t kPoints = 600;
constexpr int kUpdates = 40;  ///< of a phase, more than between two looks

std::unique_ptr<PairSearch> search_for_auto() {
  HierarchyParams params;
  params.radius = kAutoRadius;
  return make_search("auto", params);
}

const Vec3 kMiddle{kAutoSide / 2, kAutoSide / 2, kAutoSide / 2};

/// Of density 1 where there is anything.
std::vector<Vec3> even_ball(scenes::Random& random) {
  std::vector<Vec3> points;
  while (points.size() < kPoints) points.push_back(kMiddle + random.in_ball(5.2));
  return points;
}
/// Six in a place here and there.
std::vector<Vec3> crowds(scenes::Random& random) {
  std::vector<Vec3> points;
  while (points.size() < kPoints) {
    const Vec3 place{kAutoSide * random.uniform(), kAutoSide * random.uniform(),
                     kAutoSide * random.uniform()};
    for (int k = 0; k < 6; ++k) points.push_back(place + random.in_ball(0.8));
  }
  return points;
}

/// What changes from update to update beside the positions.
struct Run {
  bool keys = false;   ///< with particles that come and go
  bool pairs = false;  ///< cluster pairs are asked for now and then
};

/// Even, crowded, even, crowded: the engines seen in each phase, one letter a change.
std::string engines_seen(const Run& run) {
  const auto search = search_for_auto();
  const Box box = Box::orthorhombic({kAutoSide, kAutoSide, kAutoSide});
  scenes::Random random(3);
  std::string seen;
  for (int phase = 0; phase < 4; ++phase) {
    std::vector<Vec3> points = phase % 2 == 0 ? even_ball(random) : crowds(random);
    std::vector<std::uint64_t> keys(points.size());
    for (std::size_t k = 0; k < keys.size(); ++k) keys[k] = k;
    for (int update = 0; update < kUpdates; ++update) {
      for (Vec3& p : points) p = p + random.in_cube(0.05);
      if (run.keys) keys[random.below(keys.size())] += kPoints * static_cast<std::uint64_t>(update + 1);
      search->update(points, box, run.keys ? Span<const std::uint64_t>(keys) : Span<const std::uint64_t>());
      const NeighborList list = search->list(within(kAutoRadius));
      const std::string difference = first_difference(list, all_pairs(points, box, within(kAutoRadius)));
      if (!difference.empty()) return "update " + std::to_string(update) + ": " + difference;
      const std::string choice = search->choice().substr(0, search->choice().find(':'));
      if (seen.size() < choice.size() || seen.substr(seen.size() - choice.size()) != choice)
        seen += (seen.empty() ? "" : " ") + choice;
      if (!run.pairs || phase != 0 || update != kUpdates - 5) continue;
      ClusterPairs pairs;
      search->cluster_pairs(within(kAutoRadius), pairs);
      const std::string fault = cluster_pair_fault(pairs, points, box, within(kAutoRadius));
      if (!fault.empty()) return fault;
    }
  }
  EXPECT_EQ(search->stats().updates, 4 * kUpdates);
  return seen;
}

TEST(AutoSearch, ChangesWithTheSceneAndLosesNoPair) {
  EXPECT_EQ(engines_seen({}), "grid dch grid dch");
  EXPECT_EQ(engines_seen({.keys = true}), "grid dch grid dch");
}

// Asked for once, near the end of the first phase.
TEST(AutoSearch, ServesListsFromTheHierarchyWhilePairsAreAskedFor) {
  EXPECT_EQ(engines_seen({.pairs = true}), "grid dch grid dch grid dch");
}

TEST(AutoSearch, LooksAtOnceWhenTheNumberOrTheBoxChanges) {
  const auto search = search_for_auto();
  scenes::Random random(4);
  EXPECT_EQ(search->choice(), "");
  const std::vector<Vec3> even = even_ball(random), crowded = crowds(random);
  for (const double side : {kAutoSide, 2 * kAutoSide, kAutoSide}) {
    const Box box = Box::orthorhombic({side, side, side});
    const std::vector<Vec3>& points = side == kAutoSide ? even : crowded;
    search->update(points, box);
    EXPECT_EQ(first_difference(search->list(within(1)), all_pairs(points, box, within(1))), "");
    EXPECT_EQ(search->choice().substr(0, 4), side == kAutoSide ? "grid" : "dch:") << search->choice();
  }
  const std::vector<Vec3> few(even.begin(), even.begin() + 5);
  search->update(few, Box::none());
  EXPECT_EQ(first_difference(search->list(within(1)), all_pairs(few, Box::none(), within(1))), "");
}

TEST(AutoSearch, HoldsNothingAfterAThrow) {
  scenes::Random random(5);
  const Box box = Box::orthorhombic({kAutoSide, kAutoSide, kAutoSide});
  for (const bool crowded : {false, true}) {
    const std::vector<Vec3> points = crowded ? crowds(random) : even_ball(random);
    const auto search = search_for_auto();
    search->update(points, box);
    search->list(within(kAutoRadius));
    ASSERT_EQ(search->choice().substr(0, 4), crowded ? "dch:" : "grid");
    std::vector<Vec3> bad = points;
    bad[5].x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(search->update(bad, box), InvalidPosition);
    EXPECT_EQ(search->list(within(kAutoRadius)).size(), 0u);
    ClusterPairs pairs;
    search->cluster_pairs(within(kAutoRadius), pairs);
    EXPECT_TRUE(pairs.entries.empty());
    EXPECT_EQ(search->validate(), "");
    EXPECT_THROW(search->list(within(1.01 * kAutoRadius)), InvalidParameter);
    search->update(points, box);
    EXPECT_EQ(
        first_difference(search->list(within(kAutoRadius)), all_pairs(points, box, within(kAutoRadius))), "");
  }
}

TEST(MakeSearch, GivesTheEngineOfTheNameOrSaysWhichThereAre) {
  HierarchyParams params;
  params.radius = 1;
  for (const char* const name : {"dch", "grid", "cell", "auto"})
    EXPECT_EQ(make_search(name, params)->name(), name);
  try {
    make_search("tree", params);
    FAIL() << "made an engine of a name that there is not";
  } catch (const InvalidParameter& error) {
    EXPECT_EQ(std::string(error.what()), "there is no engine 'tree'; take dch, grid, cell or auto");
  }
}

}  // namespace
}  // namespace dch
