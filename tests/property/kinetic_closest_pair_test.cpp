// SPDX-License-Identifier: MIT
//
// The closest pair of moving points at every time, against all pairs: in every box, for linear and quadratic
// motion, with plans changed at any time and at changes.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include <dch/kinetic/kinetic_closest_pair.hpp>

#include "closest_pair_oracle.hpp"
#include "effort.hpp"
#include "moving_scene.hpp"

namespace dch::kinetic {
namespace {

void replan(KineticClosestPair& engine, ClosestPairOracle& oracle, MovingScene& scene, std::int32_t id) {
  engine.set_motion(id, scene.velocity(), scene.acceleration());
  oracle.note(id);
}

/// Lets random things happen for a while. Returns what was counted.
ClosestCounters check_closest(MovingScene scene, double duration) {
  SCOPED_TRACE(scene.what);
  KineticClosestPair engine(scene.params.box, scene.plans, 0);
  ClosestPairOracle oracle(engine);
  const double end = duration / scene.speed;
  while (engine.now() < end && !testing::Test::HasFailure()) {
    const double until = std::min(end, engine.now() + end * 0.1 * scene.random.uniform());
    engine.advance_to(until, [&](const ClosestChange& change) {
      oracle.note(change);
      if (scene.random.below(4) == 0) replan(engine, oracle, scene, change.after.b);
    });
    oracle.check();
    for (std::size_t k = scene.random.below(3); k > 0 && !scene.plans.empty(); --k)
      replan(engine, oracle, scene, scene.any_point());
  }
  return engine.counters();
}

TEST(KineticClosestPairs, AreThoseOfAllPairsInRandomScenes) {
  ClosestCounters all;
  for (int k = 0; k < effort(200); ++k) {
    const ClosestCounters counters =
        check_closest({4200000 + static_cast<std::uint64_t>(k), static_cast<std::size_t>(k % 30)}, 3);
    ASSERT_FALSE(testing::Test::HasFailure());
    all.changes += counters.changes;
    all.cutoffs += counters.cutoffs;
    all.looks_ahead += counters.looks_ahead;
  }
  EXPECT_GT(all.changes, effort(1000));
  EXPECT_GT(all.cutoffs, effort(220));
  EXPECT_GT(all.looks_ahead, effort(100));
}

/// So few points that pairs are farther apart than edges can be, and the nearest image of one may change.
TEST(KineticClosestPairs, AreThoseOfAllPairsWherePointsAreFew) {
  std::int64_t looks_ahead = 0;
  for (int k = 0; k < effort(600); ++k) {
    looks_ahead +=
        check_closest({4300000 + static_cast<std::uint64_t>(k), static_cast<std::size_t>(3 + k % 3)}, 12)
            .looks_ahead;
    ASSERT_FALSE(testing::Test::HasFailure());
  }
  EXPECT_GT(looks_ahead, effort(10000));
}

}  // namespace
}  // namespace dch::kinetic
