// SPDX-License-Identifier: MIT
//
// Every query of ten thousand scenes, in which everything is random, that have gone through a thousand
// repairs and two thousand insertions and removals each: against all pairs, at three times on the way.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>

#include <dch/proximity/kept_closest_pair.hpp>

#include "instruction_sets.hpp"
#include "proximity_checks.hpp"
#include "proximity_scene.hpp"

namespace dch {
namespace {

constexpr int kEighths = 8, kScenesOfEighth = 1250;
/// Repairs before each check, and twice as many insertions and removals.
constexpr int kAges[] = {50, 350, 600}, kOldAge = 1000;

/// Whether CTest runs this as one of the tests labelled `long`; else a few scenes are enough.
bool is_long() {
  static const bool is_set = std::getenv("DCH_TEST_LONG") != nullptr;
  return is_set;
}

std::int64_t maintained(const ProximityScene& scene) { return scene.stats().repairs + scene.stats().builds; }

/// Where policy and motion allow that repairs are put off, there are more steps; a set that has become empty
/// has none to come.
void age(ProximityScene& scene, int steps, KeptClosestPair& kept, PointTree& tree) {
  const std::int64_t enough = maintained(scene) + steps;
  for (int step = 0; step < steps || (maintained(scene) < enough && step < 4 * steps); ++step) {
    scene.move();
    scene.exchange_one();
    scene.exchange_one();
    if (step % 100 == 0) {
      ASSERT_NO_FATAL_FAILURE(check_kept_closest_pair(scene, kept)) << "step " << step;
    }
    if (step % 4 == 0) tree.update(scene.view());
  }
}

void check_all(ProximityScene& scene, PointTree& tree) {
  ASSERT_NO_FATAL_FAILURE(check_nearest(scene));
  ASSERT_NO_FATAL_FAILURE(check_neighbors_within(scene));
  ASSERT_NO_FATAL_FAILURE(check_spanning_tree(scene));
  ASSERT_NO_FATAL_FAILURE(check_well_separated_pairs(scene));
  ASSERT_NO_FATAL_FAILURE(check_spanner(scene));
  ASSERT_NO_FATAL_FAILURE(check_centers(scene));
  ASSERT_NO_FATAL_FAILURE(check_closest_pair(scene));
  ASSERT_NO_FATAL_FAILURE(check_far_sums(scene));
  ASSERT_NO_FATAL_FAILURE(check_kept_point_tree(scene, tree));
  ASSERT_NO_FATAL_FAILURE(check_well_separated_pairs(scene, tree));
  ASSERT_NO_FATAL_FAILURE(check_spanner(scene, tree));
  ASSERT_NO_FATAL_FAILURE(check_centers(scene, tree));
  ASSERT_NO_FATAL_FAILURE(check_closest_pair(scene, tree));
}

class AgedScenes : public testing::TestWithParam<int> {};

TEST_P(AgedScenes, AnswerAsAllPairsDo) {
  const RestoreInstructionSet restore;
  const auto sets = supported_sets();
  const int scenes = is_long() ? kScenesOfEighth : 1;
  std::int64_t repairs = 0, changes = 0;
  for (int k = 0; k < scenes; ++k) {
    // A quarter of the scenes have so few points that centers are compared with the best ones.
    const bool is_small = k % 4 == 3;
    ProximityScene scene(9100000 + static_cast<std::uint64_t>(GetParam() * kScenesOfEighth + k),
                         is_small ? 24 : 200, 5);
    set_instruction_set(sets[scene.random.below(sets.size())]);
    KeptClosestPair kept;
    PointTree tree(scene.view());
    for (const int steps : kAges) {
      ASSERT_NO_FATAL_FAILURE(age(scene, steps, kept, tree));
      ASSERT_NO_FATAL_FAILURE(check_all(scene, tree)) << "after " << maintained(scene) << " repairs";
    }
    repairs += maintained(scene);
    changes += scene.stats().inserted + scene.stats().removed;
  }
  std::printf("%d scenes: %lld repairs or builds, %lld insertions and removals\n", scenes,
              static_cast<long long>(repairs), static_cast<long long>(changes));
  EXPECT_GE(repairs, std::int64_t{scenes} * kOldAge);
  EXPECT_GE(changes, std::int64_t{scenes} * 2 * kOldAge);
}

INSTANTIATE_TEST_SUITE_P(Eighths, AgedScenes, testing::Range(0, kEighths));

}  // namespace
}  // namespace dch
