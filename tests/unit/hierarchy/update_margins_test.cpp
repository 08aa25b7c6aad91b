// SPDX-License-Identifier: MIT
//
// How far the searches for single points look, to the last digit. What lies beyond can be no parent and no
// neighbor, so this shows in counted work alone: a node as far as a search reaches is looked into, and one
// farther by a digit is not.
#include <cmath>
#include <gtest/gtest.h>

#include "exact_scene.hpp"
#include "listed_hierarchy.hpp"

namespace dch {
namespace {

/// Distances that the insertion of a point takes after those of `before`, the first of which is in all
/// levels.
std::int64_t work_of(const std::vector<Vec3>& before, Vec3 p, std::int32_t near = -1) {
  ListedHierarchy h(params_of(EdgeRule::additive, 1));
  h.build({before.data(), 1}, Box::none());
  for (std::size_t k = 1; k < before.size(); ++k) h.insert(before[k]);
  const std::int64_t distances = h.stats().distances;
  h.insert(p, near);
  return h.stats().distances - distances;
}

/// The number near `guess` for which `is_it` holds.
template <class Is>
double number_near(double guess, const Is& is_it) {
  double x = guess;
  for (int k = 0; k < 20; ++k) x = std::nextafter(x, 0);
  for (int k = 0; k < 40; ++k, x = std::nextafter(x, 2 * guess))
    if (is_it(x)) return x;
  ADD_FAILURE() << "none near " << guess;
  return guess;
}

/// A leaf with another one in the covering radius of level 1, R_1 = 2; and a point far away, for levels.
const std::vector<Vec3> kBefore{{0, 0, 0}, {0, 60, 0}, {-2, 0, 0}};

// A node of level 2 may have a child within 1 of the point if it is within 1 + R_2 - R_1 = 3 itself.
TEST(Insertion, DescendsIntoNodesUpToItsReachAndNoFarther) {
  const double reach = 3 * kInflate;
  EXPECT_GT(work_of(kBefore, {reach, 0, 0}), work_of(kBefore, {std::nextafter(reach, 4), 0, 0}));
  EXPECT_EQ(work_of(kBefore, {reach, 0, 0}), work_of(kBefore, {2.9 * kInflate, 0, 0}));
}

// The only root, of level 2.
TEST(Insertion, DescendsIntoRootsUpToItsReachAndNoFarther) {
  const std::vector<Vec3> before{{0, 0, 0}, {-2, 0, 0}};
  const double reach2 = 3.0 * 3.0 * (kInflate * kInflate);
  const double reach = number_near(3 * kInflate, [&](double x) { return x * x == reach2; });
  EXPECT_GT(work_of(before, {reach, 0, 0}), work_of(before, {std::nextafter(reach, 4), 0, 0}));
}

// Whose parent is at 6.5, and a neighbor of that at the origin. Its children may be neighbors if it is within
// rho_1 + R_1 = 5.
TEST(Insertion, LooksForEdgesAmongTheChildrenOfNodesUpToItsReachAndNoFarther) {
  std::vector<Vec3> before = kBefore;
  before.push_back({6.5, 0, 0});
  const double reach = 5 * kInflate;
  EXPECT_GT(work_of(before, {reach, 0, 0}), work_of(before, {std::nextafter(reach, 6), 0, 0}));
}

// From a leaf that is given, all that are wanted are its neighbors if the point is within rho_1 - 1 of it.
TEST(Insertion, ClimbsFromAFriendThatIsFartherThanItsSurroundingsAreWide) {
  const double room = 3 - 1 * kInflate;
  const auto work_at = [&](double x) { return work_of(kBefore, {x, 0, 0}, 0); };
  const double exact =
      number_near(room / kInflate, [&](double x) { return x * x * (kInflate * kInflate) == room * room; });
  const std::int64_t without_climbing = work_at(exact * (1 - 1e-13));
  EXPECT_EQ(work_at(exact), without_climbing);
  EXPECT_GT(work_at(exact * (1 + 1e-13)), without_climbing);
}

// A point on its own in level 2, whose leaf is not in memory: it may cover the point if it is within 1.
TEST(Insertion, ExpandsSingletonsUpToItsReachAndNoFarther) {
  const auto work_at = [](double x) {
    ListedHierarchy h(params_of(EdgeRule::additive, 1));
    const std::vector<Vec3> points{{0, 0, 0}, {-10, 0, 0}, {-10, 0.5, 0}};
    h.build(points, Box::none());
    h.update(points, Box::none());
    const auto& singletons = HierarchyTestAccess::impl(h).singletons;
    EXPECT_EQ(singletons.size(), 1u);
    EXPECT_EQ(singletons[0].level, 2);
    const std::int64_t distances = h.stats().distances;
    h.insert({x, 0, 0});
    return h.stats().distances - distances;
  };
  EXPECT_GT(work_at(kInflate), work_at(std::nextafter(kInflate, 2)));
}

TEST(Insertion, OfTwoCentersAsNearTheFirstOneIsTaken) {
  ListedHierarchy h(params_of(EdgeRule::additive, 16));
  h.build(std::vector<Vec3>{{0, 0, 0}}, Box::none());
  h.insert({1.5, 0, 0});
  EXPECT_EQ(h.parent(h.insert({0.75, 0, 0}), 0), 0);
}

// Leaves in a row that no edge of level 1 joins. The points of one that loses its center are looked for
// places beside its neighbors in level 2, not from the 50 roots.
TEST(Removal, LooksForPlacesNearTheLeafThatLostItsCenter) {
  std::vector<Vec3> points;
  for (int k = 0; k < 200; ++k) points.push_back({5.0 * k, 0, 0});
  for (int k = 0; k < 200; ++k)
    for (const double y : {-0.9, 0.9}) points.push_back({5.0 * k, y, 0});
  ListedHierarchy h(params_of(EdgeRule::additive, 64));
  h.build({points.data(), 1}, Box::none());
  for (std::size_t k = 1; k < points.size(); ++k) h.insert(points[k]);
  ASSERT_EQ(h.level(h.levels() - 1).nodes, 50);
  ASSERT_EQ(h.level(1).edges, 0);
  const std::int64_t before = h.stats().distances;
  for (std::int32_t k = 51; k < 60; k += 2) h.remove(k);
  EXPECT_LE(h.stats().distances - before, 320);
  EXPECT_EQ(h.validate(), "");
}

}  // namespace
}  // namespace dch
