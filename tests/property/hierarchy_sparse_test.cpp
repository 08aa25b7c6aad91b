// SPDX-License-Identifier: MIT
//
// A droplet and its gas in boxes hundreds of times wider than a list reaches: most points stand on their own
// in most levels, and are in memory in the others only.
#include <gtest/gtest.h>

#include <dch/lists/all_pairs.hpp>

#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"
#include "shake.hpp"

namespace dch {
namespace {

constexpr double kWide = 400;

std::vector<Vec3> droplet_and_gas(const Box& box, std::size_t liquid, std::size_t gas, std::uint64_t seed) {
  std::vector<Vec3> points = scenes::uniform_in(box, gas, seed);
  scenes::Random random(seed + 1);
  const Vec3 middle = scenes::from_fractional(box, {0.4, 0.5, 0.6});
  for (std::size_t k = 0; k < liquid; ++k) points.push_back(middle + random.in_ball(3));
  for (std::size_t k = 0; k < gas / 8; ++k)  // pairs and small clusters
    points.push_back(points[k] + random.in_cube(2));
  random.shuffle(points);
  return points;
}

/// Uniform in a box far wider than scenes::kOpenSide, where there is none.
std::vector<Vec3> scene_in(const Box& box, std::size_t liquid, std::size_t gas, std::uint64_t seed) {
  if (box.any_periodic()) return droplet_and_gas(box, liquid, gas, seed);
  return droplet_and_gas(Box::orthorhombic({kWide, kWide, kWide}), liquid, gas, seed);
}

std::vector<StructureParams> sparse_variants() {
  StructureParams wide = repairing();
  wide.base_radius = 0;
  StructureParams lazy;
  lazy.radius = kRadius;
  StructureParams expanded = repairing();
  expanded.collapse_singletons = false;
  return {repairing(),
          repairing(EdgeRule::additive, 1),
          repairing(EdgeRule::thesis, 1),
          repairing(EdgeRule::thesis, 16),
          wide,
          lazy,
          expanded};
}

class HierarchySparse : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(HierarchySparse, ValidUnderMotionAndListsEqualTheOracle) {
  const Box box = GetParam().box;
  for (const StructureParams& params : sparse_variants())
    for (const double step : {0.01, 0.3, 3.0, 40.0}) {
      std::vector<Vec3> points = scene_in(box, 150, 120, 5);
      scenes::Random random(6);
      ListedHierarchy hierarchy(params);
      hierarchy.build(points, box);
      ASSERT_EQ(hierarchy.validate(), "") << "after the build";
      for (int s = 0; s < effort(12); ++s) {
        for (Vec3& p : points) p = p + random.in_cube(step);
        hierarchy.update(points, box);
        ASSERT_EQ(hierarchy.validate(), "") << "step " << s << " of " << step;
        NeighborList list, unsorted;
        hierarchy.list(whole_list(), list);
        ASSERT_EQ(first_difference(list, all_pairs(points, box, whole_list())), "") << s << " of " << step;
        ListParams as_found = whole_list();
        as_found.order = RowOrder::unsorted;
        hierarchy.list(as_found, unsorted);
        ASSERT_EQ(unsorted.size(), points.size()) << "every point has a row";
        ASSERT_EQ(first_difference(sorted_by_index(unsorted, points.size()), list), "") << s;
      }
    }
}

// Insertion next to a singleton expands it, removal of the other and a repair collapse it again.
TEST_P(HierarchySparse, ValidUnderInsertionsAndRemovals) {
  const Box box = GetParam().box;
  for (const StructureParams& params : sparse_variants()) {
    const std::vector<Vec3> points = scene_in(box, 60, 100, 9);
    scenes::Random random(10);
    ListedHierarchy hierarchy(params);
    hierarchy.build(points, box);
    for (int operation = 0; operation < effort(120); ++operation) {
      const auto id = static_cast<std::int32_t>(random.below(hierarchy.capacity()));
      if (!hierarchy.contains(id)) continue;
      if (random.uniform() < 0.5) {
        hierarchy.remove(id);
      } else {
        const double away = std::ldexp(0.2, static_cast<int>(random.below(10)));
        hierarchy.insert(hierarchy.position(id) + random.in_ball(away), random.uniform() < 0.5 ? id : -1);
      }
      ASSERT_EQ(hierarchy.validate(), "") << "operation " << operation;
      if (operation % 20 != 19) continue;
      std::vector<Vec3> moved(hierarchy.capacity());
      for (std::size_t k = 0; k < moved.size(); ++k)
        if (hierarchy.contains(static_cast<std::int32_t>(k)))
          moved[k] = hierarchy.position(static_cast<std::int32_t>(k)) + random.in_cube(1);
      hierarchy.update(moved, box);
      ASSERT_EQ(hierarchy.validate(), "") << "motion after operation " << operation;
    }
    for (std::size_t id = 0; id < hierarchy.capacity(); ++id)
      if (hierarchy.contains(static_cast<std::int32_t>(id))) hierarchy.remove(static_cast<std::int32_t>(id));
    EXPECT_EQ(hierarchy.validate(), "");
    EXPECT_EQ(hierarchy.size(), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(WideBoxes, HierarchySparse, ::testing::ValuesIn(scenes::all_boxes(kWide)),
                         [](const auto& p) { return p.param.name; });

// Gas that becomes denser and denser, and thinner again.
TEST(HierarchySparse, ValidWhileTheBoxChanges) {
  const std::vector<Vec3> fractional = scenes::uniform(250, {1, 1, 1}, 4);
  ListedHierarchy hierarchy(repairing());
  for (const double width : {500.0, 100.0, 20.0, 6.0, 30.0, 300.0, 2000.0}) {
    const Box box = Box::orthorhombic({width, width, width});
    std::vector<Vec3> points;
    for (const Vec3 f : fractional) points.push_back(width * f);
    if (hierarchy.capacity() == 0) hierarchy.build(points, box);
    hierarchy.update(points, box);
    ASSERT_EQ(hierarchy.validate(), "") << width;
  }
}

}  // namespace
}  // namespace dch
