// SPDX-License-Identifier: MIT
#include "scene.hpp"

namespace dch::bench {

void RandomScene::start() {
  first_ = positions;
  first_box_ = box;
  engine_.seed(seed_);
}

bool RandomScene::step() {
  if (tethered) positions = first_;
  for (Vec3& p : positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] += step_length * (2 * uniform(engine_) - 1);
  for (std::size_t i = 0; i < drift.size(); ++i) positions[i] = positions[i] + drift[i];
  if (strain != 0) shear();
  return true;
}

void RandomScene::shear() {
  for (Vec3& p : positions) p.x += strain * p.y;
  const Vec3 a = box.vector(0), c = box.vector(2);
  Vec3 b = box.vector(1);
  b.x += strain * b.y;
  if (b.x > a.x / 2) b.x -= a.x;  // the same lattice
  box = Box::triclinic(a, b, c);
}

void RandomScene::restart() {
  positions = first_;
  box = first_box_;
  engine_.seed(seed_);
}

}  // namespace dch::bench
