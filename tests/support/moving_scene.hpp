// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <dch/kinetic/kinetic_edges.hpp>

#include "scenes.hpp"

namespace dch::kinetic {

/// Points under way in which nothing is chosen by hand but how many they are.
struct MovingScene {
  MovingScene(std::uint64_t seed, std::size_t points) : random(seed) {
    const auto boxes = scenes::all_boxes(random.uniform(3, 7));
    const scenes::NamedBox& box = boxes[random.below(boxes.size())];
    params.box = box.box;
    const double widest = std::min(1.2, kMaxShareOfBox * box.box.max_cutoff());
    params.cutoff = widest * random.uniform(0.3, 1);
    is_curved = random.below(2) == 0;
    speed = random.below(3) == 0 ? 20 : 1;
    const auto sets = scenes::hard_point_sets(box.box, points, 0.4);
    const auto& set = sets[random.below(sets.size())];
    for (const Vec3 p : set.points) plans.push_back({random.uniform(-0.1, 0), p, velocity(), acceleration()});
    if (random.below(2) == 0)
      for (std::size_t i = 0; i < plans.size(); ++i)
        params.radii.push_back(0.5 * widest * std::pow(20, -random.uniform()));
    what = "seed " + std::to_string(seed) + ": " + std::to_string(plans.size()) + " points, " + set.name +
           ", " + box.name + (is_curved ? ", curved" : ", straight") +
           (params.radii.empty() ? "" : ", radii") + ", speed " + std::to_string(speed);
  }

  Vec3 velocity() { return speed * random.in_cube(random.below(10) == 0 ? 5 : 1); }
  Vec3 acceleration() { return is_curved ? speed * speed * random.in_cube(1) : Vec3{}; }
  std::int32_t any_point() { return static_cast<std::int32_t>(random.below(plans.size())); }

  scenes::Random random;
  KineticParams params;
  std::vector<FlightPlan> plans;
  bool is_curved = false;
  double speed = 1;
  std::string what;
};

}  // namespace dch::kinetic
