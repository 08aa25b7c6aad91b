// SPDX-License-Identifier: MIT
//
// A checker that cannot fail is worthless: every kind of fault is planted once and has to be reported.
#include <gtest/gtest.h>

#include <dch/hierarchy.hpp>

#include "hierarchy_test_access.hpp"
#include "scenes.hpp"

namespace dch {

namespace {

class ValidateTest : public ::testing::Test {
 protected:
  ValidateTest() : hierarchy_(params()) {
    hierarchy_.build(scenes::uniform(400, {10, 10, 10}, 7), Box::orthorhombic({10, 10, 10}));
  }
  static HierarchyParams params() {
    HierarchyParams p;
    p.radius = 1.5;
    return p;
  }
  HierarchyTestAccess::Impl& inside() { return HierarchyTestAccess::impl(hierarchy_); }
  /// A node of the level that does not stand in the level above.
  std::int32_t plain_node(int level) {
    const auto& at = inside().levels[level];
    for (std::int32_t k = 0; k < at.size(); ++k)
      if (at.is_alive(k) && at.up[k] == detail::kNone) return k;
    ADD_FAILURE() << "no plain node in level " << level;
    return 0;
  }
  void expect_report(const std::string& part) {
    const std::string report = hierarchy_.validate();
    EXPECT_NE(report.find(part), std::string::npos) << "reported: '" << report << "'";
  }

  Hierarchy hierarchy_;
};

TEST_F(ValidateTest, SoundHierarchyPasses) {
  ASSERT_GE(hierarchy_.levels(), 4);
  EXPECT_EQ(hierarchy_.validate(), "");
}

TEST_F(ValidateTest, ReportsAPointFarFromItsParent) {
  const std::int32_t k = plain_node(0);
  inside().levels[0].position[k] = inside().box.wrap(inside().levels[0].position[k] + Vec3{5, 5, 5});
  expect_report("from its parent");
}

TEST_F(ValidateTest, ReportsAMissingEdge) {
  auto& level = inside().levels[kFirstStoredLevel];
  const std::int32_t k = plain_node(kFirstStoredLevel);
  ASSERT_FALSE(level.edges.row(k).empty());
  level.edges.erase(k, level.edges.row(k)[0]);
  expect_report("is missing");
}

TEST_F(ValidateTest, ReportsAnEdgeBeyondTheThreshold) {
  auto& level = inside().levels[kFirstStoredLevel];
  level.threshold2 *= 0.01;
  expect_report("should not exist");
}

TEST_F(ValidateTest, ReportsCentersThatAreTooClose) {
  auto& levels = inside().levels;
  levels[0].radius2 *= 4;  // claims twice the separation that there is
  expect_report("are not separated");
}

TEST_F(ValidateTest, ReportsABrokenListOfChildren) {
  const std::int32_t k = plain_node(0);
  inside().detach(0, k);
  inside().levels[0].parent[k] = 0;
  expect_report("children");
}

TEST_F(ValidateTest, ReportsANodeWithoutAParent) {
  inside().detach(0, plain_node(0));
  expect_report("has no parent");
}

TEST_F(ValidateTest, ReportsAPointThatIsNotItsOwnParent) {
  const auto& centers = inside().levels[1];
  inside().levels[0].up[centers.down[plain_node(1)]] = detail::kNone;
  expect_report("without a node below");
}

TEST_F(ValidateTest, ReportsAWrongSlot) {
  std::swap(inside().slot_of_id[0], inside().slot_of_id[1]);
  expect_report("holds another point");
}

TEST_F(ValidateTest, ReportsPositionsThatDifferBetweenLevels) {
  inside().levels[1].position[0].x += 1e-9;
  expect_report("differs from the level below");
}

TEST_F(ValidateTest, ReportsTooManyRoots) {
  inside().params.max_roots = 1;
  expect_report("roots");
}

TEST_F(ValidateTest, ReportsANeedlessLevel) {
  inside().params.max_roots = 1000;
  expect_report("is not needed");
}

}  // namespace
}  // namespace dch
