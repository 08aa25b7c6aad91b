// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>

#include <dch/kinetic/kinetic_hierarchy.hpp>

#include "moving_scene.hpp"

namespace dch::kinetic {

/// Steps both up to a time, event by event.
inline void step_both(KineticHierarchy& reference, KineticEdges& engine, double until, MovingScene& scene,
                      bool changes_plans) {
  for (;;) {
    const double next = std::min(until, reference.next_event());
    const auto expected = reference.step(next);
    ASSERT_EQ(reference.validate(), "") << "at " << reference.now();
    if (!expected && next < until) continue;
    const auto found = engine.step(until);
    ASSERT_EQ(found.has_value(), expected.has_value()) << "at " << reference.now() << " and " << engine.now();
    if (!expected) return;
    ASSERT_EQ(found->time, expected->time);
    ASSERT_EQ(found->edge, expected->edge) << "at " << expected->time;
    ASSERT_EQ(found->appears, expected->appears);
    if (!changes_plans || scene.random.below(4) > 0) continue;
    const Vec3 velocity = scene.velocity(), acceleration = scene.acceleration();
    for (KineticEdges* both : {static_cast<KineticEdges*>(&reference), &engine})
      both->set_motion(expected->edge.b, velocity, acceleration);
  }
}

/// Lets random things happen to both for a while. Returns how many events the reference had.
inline std::int64_t check_both(MovingScene scene, double duration) {
  SCOPED_TRACE(scene.what);
  auto reference = make_kinetic_hierarchy(scene.params, scene.plans, 0);
  auto engine = make_kinetic_edges(scene.params, scene.plans, 0);
  EXPECT_EQ(reference->validate(), "");
  EXPECT_EQ(reference->edges(), engine->edges());
  const double end = duration / scene.speed;
  for (int k = 1; k <= 10 && !testing::Test::HasFailure(); ++k) {
    step_both(*reference, *engine, end * k / 10, scene, true);
    EXPECT_EQ(reference->edges(), engine->edges());
    if (scene.plans.empty()) continue;
    const std::int32_t id = scene.any_point();
    const Vec3 velocity = scene.velocity(), acceleration = scene.acceleration();
    reference->set_motion(id, velocity, acceleration);
    engine->set_motion(id, velocity, acceleration);
  }
  return reference->counters().events();
}

}  // namespace dch::kinetic
