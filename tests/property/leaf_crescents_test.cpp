// SPDX-License-Identifier: MIT
//
// The points of crescents, as a hierarchy finds them whose repair is put off, against all points.
#include "lists/leaf_crescents.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>

#include "effort.hpp"
#include "geometry/metric.hpp"
#include "hierarchy/structure.hpp"
#include "hierarchy/structure_params.hpp"
#include "scenes.hpp"

namespace dch::detail {
namespace {

constexpr double kRadius = 1.3;
constexpr std::size_t kPoints = 400;

/// A crescent around some point's new place, as wide as it comes, not thinned to the ball of its cap.
Crescent random_crescent(const Structure& structure, std::int32_t i, scenes::Random& random) {
  const Vec3 then = structure.box.wrap(structure.raw[i]), way = random.in_ball(random.uniform(0, 2));
  Crescent crescent{};
  crescent.particle = i;
  crescent.now = crescent.middle = structure.box.wrap(then + way);
  crescent.from_then = structure.box.nearest_image(crescent.now - then);
  crescent.inner = random.below(3) == 0 ? -1 : random.uniform(0, 1.5);
  crescent.outer = crescent.radius = random.uniform(0.2, 4);
  return crescent;
}

/// Which points of a crescent are not found.
std::string missed(const Structure& structure, const Crescent& crescent) {
  return with_metric(structure.box, [&](const auto& metric) {
    const LeafCrescents crescents(metric, structure);
    std::set<std::int32_t> found;
    crescents.any(crescent, crescents.leaf_of(crescent.particle), [&](std::int32_t id) {
      found.insert(id);
      return false;
    });
    const Vec3 then = crescent.now - crescent.from_then;
    for (std::int32_t id = 0; id < static_cast<std::int32_t>(kPoints); ++id) {
      const Vec3 p = structure.raw[id];
      const bool is_in =
          structure.box.distance2(p, crescent.now) < crescent.outer * crescent.outer &&
          (crescent.inner < 0 || structure.box.distance2(p, then) > crescent.inner * crescent.inner);
      if (is_in && found.count(id) == 0) return std::to_string(id);
    }
    return std::string();
  });
}

class Crescents : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(Crescents, HoldAllTheirPoints) {
  int pending = 0;
  for (const double wide : {1.0, 4.0}) {
    for (const double base_radius : {kRadius / 8, kRadius / 3, kRadius}) {
      StructureParams params;
      params.radius = kRadius;
      params.base_radius = base_radius;
      const Box& given = GetParam().box;
      const Box box =
          given.kind() == Box::Kind::none
              ? given
              : Box::triclinic(wide * given.vector(0), wide * given.vector(1), wide * given.vector(2),
                               {given.periodic(0), given.periodic(1), given.periodic(2)});
      scenes::Random random(21);
      std::vector<Vec3> points = scenes::uniform_in(box, kPoints, 22);
      if (box.kind() == Box::Kind::none)
        for (Vec3& p : points) p = wide * p;
      std::vector<Vec3> drift(kPoints);
      for (Vec3& v : drift) v = random.in_ball(0.08 * base_radius);
      Hierarchy hierarchy(params);
      hierarchy.build(points, box);
      for (int step = 0; step < effort(12); ++step) {
        const Structure& structure = hierarchy.view().structure();
        pending += structure.pending;
        for (int k = 0; k < 60; ++k) {
          const auto i = static_cast<std::int32_t>(random.below(kPoints));
          ASSERT_EQ(missed(structure, random_crescent(structure, i, random)), "")
              << "of " << i << ", step " << step << ", " << wide << ", " << base_radius;
        }
        for (std::size_t i = 0; i < kPoints; ++i) points[i] = points[i] + drift[i];
        hierarchy.update(points, box);
      }
    }
  }
  EXPECT_GT(pending, effort(12)) << "the test says little if every repair is made at once";
}

INSTANTIATE_TEST_SUITE_P(Boxes, Crescents, ::testing::ValuesIn(scenes::all_boxes(6)),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace dch::detail
