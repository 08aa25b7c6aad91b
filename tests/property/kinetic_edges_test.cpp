// SPDX-License-Identifier: MIT
//
// Edges of moving points and the times at which they come and go, against all pairs: in every box, for linear
// and quadratic motion, with plans changed at any time and at events.
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include <dch/kinetic/kinetic_edges.hpp>

#include "effort.hpp"
#include "kinetic_oracle.hpp"
#include "moving_scene.hpp"

namespace dch::kinetic {
namespace {

void replan(KineticEdges& engine, KineticOracle& oracle, MovingScene& scene, std::int32_t id) {
  engine.set_motion(id, scene.velocity(), scene.acceleration());
  oracle.note(id);
}

/// Lets random things happen for a while, then compares. Returns how many events there were.
std::size_t check(MovingScene scene, double duration) {
  SCOPED_TRACE(scene.what);
  auto engine = make_kinetic_edges(scene.params, scene.plans, 0);
  KineticOracle oracle(*engine);
  std::vector<EdgeEvent> said;
  const double end = duration / scene.speed;
  while (engine->now() < end) {
    const double until = std::min(end, engine->now() + end * 0.05 * scene.random.uniform());
    engine->advance_to(until, [&](const EdgeEvent& event) {
      said.push_back(event);
      // Plans at the very time at which a pair is at its distance.
      if (scene.random.below(4) > 0) return;
      replan(*engine, oracle, scene, event.edge.a);
      if (scene.random.below(2) == 0) replan(*engine, oracle, scene, event.edge.b);
    });
    if (scene.random.below(3) == 0) oracle.check_edges();
    for (std::size_t k = scene.random.below(4); k > 0 && !scene.plans.empty(); --k)
      replan(*engine, oracle, scene, scene.any_point());
  }
  oracle.check_events(said);
  return said.size();
}

TEST(KineticEdges, AreThoseOfAllPairsInRandomScenes) {
  std::size_t events = 0;
  for (int k = 0; k < effort(200); ++k) {
    events += check({4000000 + static_cast<std::uint64_t>(k), static_cast<std::size_t>(k % 45)}, 4);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
  EXPECT_GT(events, static_cast<std::size_t>(effort(20000)));
}

/// More points than may have homes of their own, so that all get new ones now and then.
TEST(KineticEdges, AreThoseOfAllPairsInLargerScenes) {
  for (int k = 0; k < effort(4); ++k) {
    check({4100000 + static_cast<std::uint64_t>(k), 250}, 1.5);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

}  // namespace
}  // namespace dch::kinetic
