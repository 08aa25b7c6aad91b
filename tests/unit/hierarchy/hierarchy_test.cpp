// SPDX-License-Identifier: MIT
//
// More than 300 lines: one test a promise of hierarchy.hpp, in its order.
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>
#include <dch/lists/all_pairs.hpp>

#include "error_message.hpp"
#include "geometry/position_check.hpp"
#include "hierarchy/structure.hpp"
#include "hierarchy_test_access.hpp"
#include "list_params.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

StructureParams with_radius(double radius) {
  StructureParams params;
  params.radius = radius;
  return params;
}

/// Two threads, as far as tasks can tell: the parts of each run one after the other, the last of them last.
class InTurn final : public Executor {
 public:
  int threads() const override { return 2; }
  void run(int parts, const std::function<void(int)>& task) override {
    for (int part = 0; part < parts; ++part) task(part);
  }
};

// Positions are checked some at a time.
TEST(HierarchyTest, AnUpdateNamesTheOneOfManyPositionsThatIsWrong) {
  for (const std::size_t wrong : {0u, 1023u, 1024u, 2500u}) {
    std::vector<Vec3> points = scenes::uniform(3000, {20, 20, 20}, 1);
    ListedHierarchy h(with_radius(1));
    h.build(points, Box::none());
    points[wrong].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(test::message_of<InvalidPosition>([&] { h.update(points, Box::none()); }),
                testing::HasSubstr(" " + std::to_string(wrong) + " "));
  }
}

// Each thread checks a part of them.
TEST(HierarchyTest, AnUpdateOnThreadsNamesTheFirstOfManyPositionsThatAreWrong) {
  InTurn executor;
  StructureParams params = with_radius(1);
  params.executor = &executor;
  for (const std::size_t wrong : {10u, 1499u, 1500u, 2500u}) {
    std::vector<Vec3> points = scenes::uniform(3000, {20, 20, 20}, 1);
    ListedHierarchy h(params);
    h.build(points, Box::none());
    points[wrong].y = std::numeric_limits<double>::quiet_NaN();
    if (wrong < 2000) points[wrong + 100].x = std::numeric_limits<double>::infinity();
    EXPECT_THAT(test::message_of<InvalidPosition>([&] { h.update(points, Box::none()); }),
                testing::HasSubstr(" " + std::to_string(wrong) + " "));
  }
}

// A wrapped coordinate is as exact as the one that was given, and edges have to reach as much farther.
TEST(HierarchyTest, APointFarOutWidensTheThresholds) {
  const Box box = Box::orthorhombic({10, 10, 10});
  ListedHierarchy h(with_radius(1));
  h.build(scenes::uniform(500, {10, 10, 10}, 1), box);
  const double near = h.view().structure().levels[1].threshold;
  const double reach = 1e12;
  h.insert({reach, 0, 0});
  EXPECT_GE(h.view().structure().levels[1].threshold, near + detail::WrapError(box).bound(reach));
  EXPECT_EQ(h.validate(), "");
}

TEST(HierarchyTest, RefusesParametersOutOfRange) {
  EXPECT_THROW(ListedHierarchy(with_radius(0)), InvalidParameter);
  EXPECT_THROW(ListedHierarchy(with_radius(-1)), InvalidParameter);
  EXPECT_THROW(ListedHierarchy(with_radius(std::numeric_limits<double>::quiet_NaN())), InvalidParameter);
  EXPECT_THROW(ListedHierarchy(with_radius(std::numeric_limits<double>::infinity())), InvalidParameter);
  EXPECT_THROW(ListedHierarchy(with_radius(9e-31)), InvalidParameter) << "leaves hold single precision";
  EXPECT_THROW(ListedHierarchy(with_radius(1.1e30)), InvalidParameter);
  StructureParams params = with_radius(1);
  params.c = 1.04;
  EXPECT_THROW(Hierarchy{params}, InvalidParameter);
  params.c = 1.05;
  EXPECT_NO_THROW(Hierarchy{params});
  params.max_roots = 0;
  EXPECT_THROW(Hierarchy{params}, InvalidParameter);
}

TEST(HierarchyTest, TheMessageNamesTheValue) {
  try {
    StructureParams params = with_radius(1);
    params.c = 0.5;
    Hierarchy{params};
    FAIL() << "c = 0.5 was accepted";
  } catch (const InvalidParameter& error) {
    EXPECT_NE(std::string(error.what()).find("0.5"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("1.05"), std::string::npos) << error.what();
  }
}

TEST(HierarchyTest, RefusesPositionsThatAreNotNumbersAndIsEmptyAfterwards) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e101}) {
    std::vector<Vec3> points = scenes::uniform(50, {5, 5, 5}, 1);
    ListedHierarchy h(with_radius(1));
    h.build(points, Box::none());
    points[20].y = bad;
    EXPECT_THROW(h.update(points, Box::none()), InvalidPosition);
    EXPECT_EQ(h.size(), 0u);
    EXPECT_EQ(h.validate(), "");
    EXPECT_THROW(h.build(points, Box::none()), InvalidPosition);
    EXPECT_THROW(h.insert(points[20]), InvalidPosition);
    points[20].y = 0;
    h.build(points, Box::none());
    EXPECT_EQ(h.validate(), "");
  }
}

TEST(HierarchyTest, RefusesRadiiBeyondHalfTheBox) {
  const std::vector<Vec3> points = scenes::uniform(50, {4, 4, 4}, 1);
  ListedHierarchy h(with_radius(2.01));
  EXPECT_THROW(h.build(points, Box::orthorhombic({4, 4, 4})), CutoffTooLarge);
  EXPECT_NO_THROW(h.build(points, Box::orthorhombic({4, 4, 4}, {false, false, false})));
  EXPECT_THROW(h.update(points, Box::orthorhombic({5, 5, 4})), CutoffTooLarge);
}

TEST(HierarchyTest, RefusesBaseRadiiFarBeyondTheBoxInUpdatesToo) {
  const std::vector<Vec3> points = scenes::uniform(50, {2, 2, 2}, 1);
  const Box flat = Box::orthorhombic({2.1, 2.1, 100});
  StructureParams params;
  params.radius = 1;
  params.base_radius = 40;
  ListedHierarchy h(params);
  EXPECT_THROW(h.build(points, flat), InvalidParameter);
  h.build(points, Box::none());
  EXPECT_THROW(h.update(points, flat), InvalidParameter);
  EXPECT_EQ(h.size(), 0u);
}

TEST(HierarchyTest, RefusesUnknownPointsAndLevels) {
  ListedHierarchy h(with_radius(1));
  h.build(scenes::uniform(100, {8, 8, 8}, 1), Box::none());
  EXPECT_THROW(h.remove(100), InvalidParameter);
  EXPECT_THROW(h.remove(-1), InvalidParameter);
  EXPECT_THROW(h.position(100), InvalidParameter);
  EXPECT_THROW(h.top_level(100), InvalidParameter);
  EXPECT_THROW(h.level(h.levels()), InvalidParameter);
  EXPECT_THROW(h.neighbors(0, h.levels()), InvalidParameter);
  EXPECT_THROW(h.parent(0, -1), InvalidParameter);
  EXPECT_THROW(h.insert({0, 0, 0}, 100), InvalidParameter);
  EXPECT_THROW(h.update(scenes::uniform(99, {8, 8, 8}, 1), Box::none()), InvalidParameter);
  h.remove(3);
  EXPECT_THROW(h.remove(3), InvalidParameter);
}

TEST(HierarchyTest, RefusesListsBeyondItsRadius) {
  ListedHierarchy h(with_radius(1));
  h.build(scenes::uniform(100, {8, 8, 8}, 1), Box::none());
  NeighborList list;
  EXPECT_THROW(h.list(within(1.1), list), InvalidParameter);
  ListParams params = within(0.9);
  params.skin = 0.2;
  EXPECT_THROW(h.list(params, list), InvalidParameter);
  params.skin = 0.1;
  EXPECT_NO_THROW(h.list(params, list));
}

TEST(HierarchyTest, EmptyAndTinySetsWork) {
  for (const std::size_t n : {0u, 1u, 2u, 16u, 17u}) {
    ListedHierarchy h(with_radius(1));
    h.build(scenes::uniform(n, {2, 2, 2}, 1), Box::none());
    EXPECT_EQ(h.size(), n);
    EXPECT_EQ(h.validate(), "") << n;
    NeighborList list;
    h.list(within(1), list);
    EXPECT_EQ(list.size(), n);
  }
}

TEST(HierarchyTest, ThresholdsFollowTheRule) {
  StructureParams params = with_radius(3);
  params.c = 1.5;
  params.max_roots = 1;
  const std::vector<Vec3> points = scenes::uniform(4000, {12, 12, 12}, 3);
  params.base_radius = 1;
  params.policy = MaintenancePolicy::always_repair;  // which has no thresholds that allow for motion
  ListedHierarchy additive(params);
  additive.build(points, Box::none());
  params.base_radius = 0;
  params.edge_rule = EdgeRule::thesis;
  ListedHierarchy thesis(params);
  thesis.build(points, Box::none());
  ASSERT_GE(additive.levels(), 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(additive.level(i).covering_radius, std::ldexp(1.0, i));
    EXPECT_DOUBLE_EQ(thesis.level(i).edge_threshold, 2 * 1.5 * std::ldexp(1.0, i));
    if (i > 0) {
      EXPECT_DOUBLE_EQ(additive.level(i).edge_threshold,
                       additive.level(i - 1).edge_threshold + 2 * additive.level(i - 1).covering_radius);
    }
  }
  ASSERT_GT(additive.level(2).edges, 0);
  EXPECT_LT(additive.level(2).edges, thesis.level(2).edges);
}

TEST(HierarchyTest, NeighborsOfLevelZeroAreTheFullList) {
  const Box box = Box::orthorhombic({6, 6, 6});
  const std::vector<Vec3> points = scenes::uniform(300, {6, 6, 6}, 11);
  ListedHierarchy h(with_radius(1.3));
  h.build(points, box);
  NeighborList list;
  h.list(within(1.3, ListKind::full), list);
  for (std::int32_t i = 0; i < 300; ++i) {
    const auto row = list.row(i);
    EXPECT_EQ(h.neighbors(i, 0), std::vector<std::int32_t>(row.begin(), row.end())) << i;
  }
}

TEST(HierarchyTest, ParentsLeadToARootInEveryLevel) {
  ListedHierarchy h(with_radius(1));
  h.build(scenes::uniform(500, {9, 9, 9}, 2), Box::none());
  for (std::int32_t id = 0; id < 500; ++id) {
    std::int32_t at = id;
    for (int level = 0; level + 1 < h.levels(); ++level) {
      const std::int32_t parent = h.parent(at, level);
      ASSERT_GE(parent, 0);
      EXPECT_EQ(parent == at, h.top_level(at) > level);
      at = parent;
    }
    EXPECT_EQ(h.parent(at, h.levels() - 1), -1);
  }
}

// A point on its own stands in all levels up to its highest, though it is not in memory in the lower ones.
TEST(HierarchyTest, SingletonsStandInAllLevelsBelow) {
  StructureParams params = with_radius(1);
  params.base_radius = 0.5;
  params.max_roots = 1;
  for (const bool fold : {true, false}) {
    params.collapse_singletons = fold;
    ListedHierarchy h(params);
    std::vector<Vec3> points = scenes::uniform(200, {5, 5, 5}, 1);
    points.push_back({200, 0, 0});
    h.build(points, Box::none());
    EXPECT_EQ(h.validate(), "");
    const std::int32_t alone = 200;
    ASSERT_GE(h.top_level(alone), 6);
    for (int i = 0; i < h.top_level(alone); ++i) {
      EXPECT_EQ(h.parent(alone, i), alone) << i;
      if (i < 5) {
        EXPECT_TRUE(h.neighbors(alone, i).empty()) << i;
      }
    }
    EXPECT_EQ(h.level(0).nodes, 201);
    std::int64_t standing = 0;
    for (std::int32_t id = 0; id <= alone; ++id) standing += h.top_level(id) >= 2;
    EXPECT_EQ(h.level(2).nodes, standing);
    EXPECT_THROW(h.neighbors(alone, h.levels()), InvalidParameter);
    EXPECT_THROW(h.parent(alone, -1), InvalidParameter);
    h.remove(alone);
    EXPECT_EQ(h.validate(), "");
  }
}

// Path compression: the box around a droplet and its gas may be as wide as it likes.
TEST(HierarchyTest, MemoryDoesNotGrowWithTheBox) {
  const auto bytes_in = [](double width) {
    ListedHierarchy h(with_radius(1));
    std::vector<Vec3> points = scenes::uniform(4000, {12, 12, 12}, 3);
    for (const Vec3 f : scenes::uniform(400, {1, 1, 1}, 4)) points.push_back(width * f);
    h.build(points, Box::orthorhombic({width, width, width}));
    NeighborList list;
    h.list(within(1), list);
    return static_cast<double>(h.stats().memory_bytes);
  };
  const double narrow = bytes_in(200);
  for (const double width : {1e3, 1e5, 1e7}) EXPECT_LT(bytes_in(width), 1.1 * narrow) << width;
}

TEST(HierarchyTest, RenumberingKeepsTheStructure) {
  std::vector<Vec3> points = scenes::uniform(200, {6, 6, 6}, 4);
  ListedHierarchy h(with_radius(1));
  h.build(points, Box::none());
  std::vector<std::int32_t> reversed(200);
  std::iota(reversed.rbegin(), reversed.rend(), 0);
  h.renumber(reversed);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(h.validate(), "");
  NeighborList list;
  h.list(within(1), list);
  EXPECT_EQ(list.j, all_pairs(points, Box::none(), within(1)).j);

  reversed[7] = reversed[8];
  EXPECT_THROW(h.renumber(reversed), InvalidParameter);
  reversed.pop_back();
  EXPECT_THROW(h.renumber(reversed), InvalidParameter);
}

TEST(HierarchyTest, IdsOfRemovedPointsAreUsedAgain) {
  ListedHierarchy h(with_radius(1));
  h.build(scenes::uniform(30, {3, 3, 3}, 4), Box::none());
  h.remove(7);
  h.remove(3);
  EXPECT_FALSE(h.contains(3));
  EXPECT_EQ(h.size(), 28u);
  EXPECT_EQ(h.capacity(), 30u);
  EXPECT_EQ(h.insert({1, 1, 1}), 3);
  EXPECT_EQ(h.insert({1, 1, 2}), 7);
  EXPECT_EQ(h.insert({1, 1, 2.5}), 30);
  EXPECT_EQ(h.position(30), (Vec3{1, 1, 2.5}));
  EXPECT_EQ(h.position(3), (Vec3{1, 1, 1}));
  EXPECT_EQ(h.validate(), "");
}

TEST(HierarchyTest, PolicyIsObeyed) {
  std::vector<Vec3> points = scenes::uniform(500, {8, 8, 8}, 6);
  StructureParams params = with_radius(1);
  params.policy = MaintenancePolicy::always_rebuild;
  ListedHierarchy rebuilding(params);
  params.policy = MaintenancePolicy::always_repair;
  ListedHierarchy repairing(params);
  for (Hierarchy* h : {&rebuilding, &repairing}) {
    h->build(points, Box::none());
    for (int step = 0; step < 5; ++step) h->update(points, Box::none());
  }
  EXPECT_EQ(rebuilding.stats().builds, 6);
  EXPECT_EQ(rebuilding.stats().repairs, 0);
  EXPECT_EQ(repairing.stats().builds, 1);
  EXPECT_EQ(repairing.stats().repairs, 5);
}

TEST(HierarchyTest, RepairIsPutOffWhileTheEdgesAreCertified) {
  ListedHierarchy h(with_radius(1));
  std::vector<Vec3> points = scenes::uniform(3000, {12, 12, 12}, 6);
  const Box box = Box::orthorhombic({12, 12, 12});
  h.build(points, box);
  EXPECT_FALSE(h.repair_pending());
  for (Vec3& p : points) p.x += 1e-3;
  h.update(points, box);
  EXPECT_TRUE(h.repair_pending());
  EXPECT_EQ(h.stats().refreshes, 1);
  EXPECT_EQ(h.stats().repairs, 0);
  EXPECT_EQ(h.validate(), "");
  NeighborList list;
  h.list(within(1), list);
  EXPECT_EQ(list.j, all_pairs(points, box, within(1)).j);

  h.repair();
  EXPECT_FALSE(h.repair_pending());
  EXPECT_EQ(h.stats().repairs, 1);
  EXPECT_EQ(h.validate(), "");

  h.update(points, Box::orthorhombic({12.001, 12, 12}));  // displacements say nothing in another box
  EXPECT_FALSE(h.repair_pending());
  EXPECT_EQ(h.validate(), "");
}

TEST(HierarchyTest, InsertionAndRemovalDoThePendingRepairFirst) {
  ListedHierarchy h(with_radius(1));
  std::vector<Vec3> points = scenes::uniform(500, {6, 6, 6}, 6);
  h.build(points, Box::none());
  points[3].x += 1e-3;
  h.update(points, Box::none());
  ASSERT_TRUE(h.repair_pending());
  h.remove(3);
  EXPECT_FALSE(h.repair_pending());
  EXPECT_EQ(h.validate(), "");
  h.update(points, Box::none());
  points[4].x += 1e-3;
  h.update(points, Box::none());
  ASSERT_TRUE(h.repair_pending());
  EXPECT_EQ(h.insert({1, 1, 1}), 3);
  EXPECT_FALSE(h.repair_pending());
  EXPECT_EQ(h.validate(), "");
}

// Counted by hand: with one level all nodes are roots, and a descent tests each of them.
TEST(HierarchyStats, CountsDistancesOfBuildInsertionRepairAndRemoval) {
  ListedHierarchy h(with_radius(1));
  auto counted = [&, before = std::int64_t{0}]() mutable {
    return h.stats().distances - std::exchange(before, h.stats().distances);
  };
  std::vector<Vec3> points{{0, 0, 0}};
  h.build(points, Box::none());
  EXPECT_EQ(counted(), 2);  // to its own center, for the nearest one and whether it covers
  points.push_back({20, 0, 0});
  h.insert(points.back());
  EXPECT_EQ(counted(), 2);  // the only root, for a parent and then for an edge
  points.push_back({0.1, 0, 0});
  h.insert(points.back());
  EXPECT_EQ(counted(), 2);  // both roots, and no new one
  points[0].x = 0.01;
  h.update(points, Box::none());
  EXPECT_EQ(counted(), 3);  // each from its center
  h.remove(2);
  EXPECT_EQ(counted(), 4);  // the repair that was put off: both roots with both
}

}  // namespace
}  // namespace dch
