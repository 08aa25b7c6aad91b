// SPDX-License-Identifier: MIT
//
// A checker that cannot fail is worthless: every kind of fault is planted once and has to be reported.
#include <gtest/gtest.h>

#include "hierarchy_test_access.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {

namespace {

class ValidateTest : public ::testing::Test {
 protected:
  ValidateTest() : hierarchy_(params()) {
    hierarchy_.build(scenes::uniform(400, {10, 10, 10}, 7), Box::orthorhombic({10, 10, 10}));
  }
  static StructureParams params() {
    StructureParams p;
    p.radius = 1.5;
    p.base_radius = 0.7;
    p.max_roots = 1;
    return p;
  }
  HierarchyTestAccess::Impl& inside() { return HierarchyTestAccess::impl(hierarchy_); }
  /// A node of the level that does not stand in the level above.
  std::int32_t plain_node(int level) {
    for (std::int32_t k = 0; k < inside().size(level); ++k)
      if (inside().is_alive(level, k) && inside().up(level, k) == detail::kNone) return k;
    ADD_FAILURE() << "no plain node in level " << level;
    return 0;
  }
  void expect_report(const std::string& part) {
    const std::string report = hierarchy_.validate();
    EXPECT_NE(report.find(part), std::string::npos) << "reported: '" << report << "'";
  }

  ListedHierarchy hierarchy_;
};

TEST_F(ValidateTest, SoundHierarchyPasses) {
  ASSERT_GE(hierarchy_.levels(), 4);
  EXPECT_EQ(hierarchy_.validate(), "");
}

TEST_F(ValidateTest, ReportsAPointFarFromItsParent) {
  const std::int32_t k = plain_node(0);
  Vec3& at = inside().points.position[k];
  at = inside().box.wrap(at + Vec3{5, 5, 5});
  expect_report("from its parent");
}

TEST_F(ValidateTest, ReportsAMissingEdge) {
  auto& level = inside().levels[1];
  const std::int32_t k = plain_node(1);
  ASSERT_FALSE(level.edges.row(k).empty());
  level.edges.erase(k, level.edges.row(k)[0]);
  expect_report("is missing");
}

TEST_F(ValidateTest, ReportsAnEdgeBeyondTheThreshold) {
  auto& level = inside().levels[1];
  level.threshold2 *= 0.01;
  expect_report("should not exist");
}

TEST_F(ValidateTest, ReportsAnEdgeLongerThanAnyWasMade) {
  auto& level = inside().levels[2];
  ASSERT_GT(level.size(), 1);
  EXPECT_GT(level.longest, level.threshold);
  level.longest *= 0.5;  // claims that edges were made shorter
  expect_report("is longer than any should be");
}

TEST_F(ValidateTest, ReportsCentersThatAreTooClose) {
  auto& levels = inside().levels;
  levels[0].radius2 *= 4;  // claims twice the separation that there is
  expect_report("are not separated");
}

TEST_F(ValidateTest, ReportsABrokenListOfChildren) {
  const std::int32_t k = plain_node(1);
  const std::int32_t parent = inside().levels[1].parent[k];
  inside().detach(1, k);
  inside().levels[1].parent[k] = parent;
  expect_report("children");
}

TEST_F(ValidateTest, ReportsADeadNodeWithChildren) {
  auto& level = inside().levels[1];
  const std::int32_t dead = level.add(detail::kNone, {});
  level.retire(dead);
  ASSERT_EQ(hierarchy_.validate(), "");
  level.first_child[dead] = level.first_child[plain_node(1)];
  expect_report("a dead node has edges or children");
}

TEST_F(ValidateTest, ReportsANodeWithoutAParent) {
  inside().detach(1, plain_node(1));
  expect_report("has no parent");
}

TEST_F(ValidateTest, ReportsAPointThatIsNotItsOwnParent) {
  const std::int32_t other_slot = inside().levels[1].down[0] == 0 ? 1 : 0;
  inside().levels[1].down[0] = other_slot;
  expect_report("without a node below");
}

TEST_F(ValidateTest, ReportsABlockOfAnotherLeaf) {
  inside().points.leaf[inside().levels[1].first_child[0]] = 1;
  expect_report("are not its own");
}

TEST_F(ValidateTest, ReportsABlockInNoChain) {
  auto& level = inside().levels[1];
  const std::int32_t first = level.first_child[0];
  level.first_child[0] = inside().points.next[first];
  expect_report("in blocks");
}

TEST_F(ValidateTest, ReportsABlockThatIsNotLinkedBack) {
  auto& points = inside().points;
  const std::int32_t first = inside().levels[1].first_child[0];
  points.prev[first] = first == 0 ? 1 : 0;
  expect_report("is not linked back to");
}

TEST_F(ValidateTest, ReportsAGapInABlock) {
  auto& points = inside().points;
  const std::int32_t block = inside().levels[1].first_child[0];
  points.id[block * detail::kBlock] = detail::kNone;
  expect_report("filled from the front");
}

TEST_F(ValidateTest, ReportsAWrongSlot) {
  std::swap(inside().slot_of_id[0], inside().slot_of_id[1]);
  expect_report("holds another point");
}

TEST_F(ValidateTest, ReportsPositionsThatDifferBetweenLevels) {
  inside().levels[1].position[0].x += 1e-9;
  expect_report("differs from the level below");
}

TEST_F(ValidateTest, ReportsAMissingEdgeWhileRepairIsPending) {
  std::vector<Vec3> points;
  for (std::int32_t id = 0; id < 400; ++id) points.push_back(hierarchy_.position(id));
  hierarchy_.update(points, hierarchy_.box());
  ASSERT_TRUE(hierarchy_.repair_pending());
  EXPECT_EQ(hierarchy_.validate(), "");
  inside().levels[1].edges.clear_row(0);
  expect_report("have parents that no edge joins");
}

/// A dense cube and three points far from it and from each other.
class ValidateSingletonsTest : public ::testing::Test {
 protected:
  ValidateSingletonsTest() : hierarchy_(params()) {
    std::vector<Vec3> points = scenes::uniform(200, {8, 8, 8}, 7);
    for (const Vec3 far : {Vec3{100, 0, 0}, Vec3{0, 200, 0}, Vec3{0, 0, 300}}) points.push_back(far);
    hierarchy_.build(points, Box::none());
  }
  static StructureParams params() {
    StructureParams p;
    p.radius = 1.5;
    p.base_radius = 0.7;
    p.max_roots = 1;
    return p;
  }
  HierarchyTestAccess::Impl& inside() { return HierarchyTestAccess::impl(hierarchy_); }
  void expect_report(const std::string& part) {
    const std::string report = hierarchy_.validate();
    EXPECT_NE(report.find(part), std::string::npos) << "reported: '" << report << "'";
  }
  ListedHierarchy hierarchy_;
};

TEST_F(ValidateSingletonsTest, SoundHierarchyPasses) {
  EXPECT_EQ(hierarchy_.validate(), "");
  ASSERT_EQ(inside().singletons.size(), 3u);
}

TEST_F(ValidateSingletonsTest, ReportsASingletonThatHasNeighbors) {
  const auto [level, node] = inside().singletons[0];
  const Vec3 near_the_others = hierarchy_.position(0) + Vec3{0.01, 0, 0};
  for (int i = level; i < hierarchy_.levels(); ++i)  // all its nodes
    for (std::int32_t k = 0; k < inside().levels[i].size(); ++k)
      if (inside().levels[i].id[k] == inside().id(level, node))
        inside().levels[i].position[k] = near_the_others;
  EXPECT_NE(hierarchy_.validate(), "");
}

TEST_F(ValidateSingletonsTest, ReportsASingletonThatAnotherPlaceClaims) {
  std::swap(inside().singletons[0], inside().singletons[1]);
  expect_report("is not that of its point");
}

TEST_F(ValidateSingletonsTest, ReportsASingletonWithAnEdge) {
  const auto [level, node] = inside().singletons[0];
  inside().levels[level].edges.push(node, node == 0 ? 1 : 0);
  expect_report("is not on its own");
}

TEST_F(ValidateTest, ReportsTooManyRoots) {
  inside().params.max_roots = 0;
  expect_report("roots");
}

TEST_F(ValidateTest, ReportsANeedlessLevel) {
  inside().params.max_roots = 1000;
  expect_report("is not needed");
}

}  // namespace
}  // namespace dch
