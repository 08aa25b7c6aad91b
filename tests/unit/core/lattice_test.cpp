// SPDX-License-Identifier: MIT
#include "geometry/lattice.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "scenes.hpp"

namespace dch::detail {
namespace {

TEST(Lattice, GiveIntegersOfLatticeVectorsAndBack) {
  for (const scenes::NamedBox& scene : scenes::all_boxes(5)) {
    const Lattice images(scene.box);
    scenes::Random random(3);
    for (int trial = 0; trial < 100; ++trial) {
      Vec3 n, v;
      for (int axis = 0; axis < 3; ++axis) {
        if (!scene.box.periodic(axis)) continue;
        n[axis] = std::nearbyint(random.uniform(-20, 20));
        v = v + n[axis] * scene.box.vector(axis);
      }
      EXPECT_EQ(images.integers(v), n) << scene.name;
      EXPECT_LT(norm2(images.vector(n) - v), 1e-20) << scene.name;
    }
  }
}

// Along open axes the cell vectors say nothing of images, however near they are to the span of the others.
TEST(Lattice, GoByThePeriodicVectorsAlone) {
  const Vec3 a{0.8, 0, 0.6}, b{0.36, 0.8, -0.48};
  const Vec3 c = a + b + 1e-10 * cross(a, b);
  for (const Box& box :
       {Box::triclinic(a, b, c, {true, true, false}), Box::triclinic(a, c, b, {true, false, true}),
        Box::triclinic(c, a, b, {false, true, true}), Box::triclinic(a, c, b, {true, false, false})}) {
    const Lattice images(box);
    for (const double periods : {3.0, 1e5 + 1, 1e8 + 7}) {
      Vec3 n, v;
      for (int axis = 0; axis < 3; ++axis) {
        if (!box.periodic(axis)) continue;
        n[axis] = axis % 2 == 0 ? periods : 5 - periods;
        v = v + n[axis] * box.vector(axis);
      }
      EXPECT_EQ(images.integers(v), n) << box.description() << ", " << periods;
      EXPECT_EQ(images.vector({periods, periods, periods}) == Vec3{}, !box.any_periodic());
    }
    EXPECT_EQ(images.vector(
                  {box.periodic(0) ? 0.0 : 1.0, box.periodic(1) ? 0.0 : 1.0, box.periodic(2) ? 0.0 : 1.0}),
              Vec3{});
  }
}

}  // namespace
}  // namespace dch::detail
