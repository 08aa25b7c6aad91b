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
#include "scenes.hpp"

namespace dch::kinetic {
namespace {

/// A scene in which nothing is chosen by hand but how many points there are.
class MovingScene {
 public:
  MovingScene(std::uint64_t seed, std::size_t points) : random_(seed) {
    const auto boxes = scenes::all_boxes(random_.uniform(3, 7));
    const scenes::NamedBox& box = boxes[random_.below(boxes.size())];
    params_.box = box.box;
    const double widest = std::min(1.2, kLargestShareOfBox * box.box.max_cutoff());
    params_.cutoff = widest * random_.uniform(0.3, 1);
    if (random_.below(2) == 0)
      for (std::size_t i = 0; i < points; ++i)
        params_.radii.push_back(0.5 * widest * std::pow(20, -random_.uniform()));
    is_curved_ = random_.below(2) == 0;
    speed_ = random_.below(3) == 0 ? 20 : 1;
    const auto sets = scenes::hard_point_sets(box.box, points, 0.4);
    const auto& set = sets[random_.below(sets.size())];
    for (const Vec3 p : set.points) plans_.push_back({random_.uniform(-0.1, 0), p, velocity(), acceleration()});
    if (!params_.radii.empty()) params_.radii.resize(plans_.size(), 0.3 * widest);
    what_ = "seed " + std::to_string(seed) + ": " + std::to_string(plans_.size()) + " points, " + set.name +
            ", " + box.name + (is_curved_ ? ", curved" : ", straight") +
            (params_.radii.empty() ? "" : ", radii") + ", speed " + std::to_string(speed_);
  }

  /// Lets random things happen, then compares. Returns how many events there were.
  std::size_t check(double duration) {
    SCOPED_TRACE(what_);
    auto engine = make_kinetic_edges(params_, plans_, 0);
    KineticOracle oracle(*engine);
    std::vector<EdgeEvent> said;
    const double end = duration / speed_;
    while (engine->now() < end) {
      const double until = std::min(end, engine->now() + end * 0.05 * random_.uniform());
      engine->advance_to(until, [&](const EdgeEvent& event) {
        said.push_back(event);
        if (random_.below(4) == 0) bounce(*engine, oracle, event);
      });
      if (random_.below(3) == 0) oracle.check_edges();
      for (std::size_t k = random_.below(4); k > 0 && !plans_.empty(); --k)
        replan(*engine, oracle, static_cast<std::int32_t>(random_.below(plans_.size())));
    }
    oracle.check_events(said);
    return said.size();
  }

 private:
  Vec3 velocity() { return speed_ * random_.in_cube(random_.below(10) == 0 ? 5 : 1); }
  Vec3 acceleration() { return is_curved_ ? speed_ * speed_ * random_.in_cube(1) : Vec3{}; }
  void replan(KineticEdges& engine, KineticOracle& oracle, std::int32_t id) {
    engine.set_motion(id, velocity(), acceleration());
    oracle.note(id);
  }
  /// Both points get plans at the very time at which they are at their distance.
  void bounce(KineticEdges& engine, KineticOracle& oracle, const EdgeEvent& event) {
    replan(engine, oracle, event.edge.a);
    if (random_.below(2) == 0) replan(engine, oracle, event.edge.b);
  }

  scenes::Random random_;
  KineticParams params_;
  std::vector<FlightPlan> plans_;
  bool is_curved_ = false;
  double speed_ = 1;
  std::string what_;
};

TEST(KineticEdges, AreThoseOfAllPairsInRandomScenes) {
  std::size_t events = 0;
  for (int k = 0; k < effort(400); ++k) {
    events += MovingScene(4000000 + static_cast<std::uint64_t>(k), static_cast<std::size_t>(k % 45)).check(4);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
  EXPECT_GT(events, static_cast<std::size_t>(effort(40000)));
}

/// More points than may have homes of their own, so that all get new ones now and then.
TEST(KineticEdges, AreThoseOfAllPairsInLargerScenes) {
  for (int k = 0; k < effort(8); ++k) {
    MovingScene(4100000 + static_cast<std::uint64_t>(k), 250).check(1.5);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

}  // namespace
}  // namespace dch::kinetic
