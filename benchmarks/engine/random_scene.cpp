// SPDX-License-Identifier: MIT
#include "scene.hpp"

namespace dch::bench {

void RandomScene::start() {
  first_ = positions;
  engine_.seed(seed_);
}

bool RandomScene::step() {
  for (Vec3& p : positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] += step_length * (2 * uniform(engine_) - 1);
  for (std::size_t i = 0; i < drift.size(); ++i) positions[i] = positions[i] + drift[i];
  return true;
}

void RandomScene::restart() {
  positions = first_;
  engine_.seed(seed_);
}

}  // namespace dch::bench
