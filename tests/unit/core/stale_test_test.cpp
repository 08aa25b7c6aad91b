// SPDX-License-Identifier: MIT
//
// What rounding takes from the skin, to the last digit: a skin that is exactly as wide as that keeps a list
// of particles that stand still, and one a little less wide does not.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/geometry/box.hpp>
#include <dch/lists/stale_test.hpp>

#include "geometry/position_check.hpp"

namespace dch {
namespace {

using detail::WrapError;

bool is_kept(double skin, const Box& box, const std::vector<Vec3>& before, const std::vector<Vec3>& now) {
  StaleTest test(skin);
  // Whatever it was told before.
  test.remember(std::vector<Vec3>{box.origin(), Vec3{1, 2, 3}}, Box::orthorhombic({10, 10, 10}));
  test.remember(before, box);
  return !test.is_stale(now, box);
}

/// The least skin with which a list of particles that stand still is kept, to some hundred digits of the last
/// place: there are the error of the places that are remembered, twice, and four times that of displacements.
double least_skin(const Box& box, const std::vector<Vec3>& points) {
  const WrapError error(box);
  double reach = 0;
  Vec3 low = box.wrap(points[0]), high = low;
  for (const Vec3 p : points) {
    reach = std::max(reach, error.reach(p));
    const Vec3 at = box.wrap(p);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], at[axis]);
      high[axis] = std::max(high[axis], at[axis]);
    }
  }
  return 2 * (2 * error.bound(reach) + 4 * error.bound(error.reach_between(low, high)));
}

struct Cell {
  const char* name;
  Box box;
};
std::vector<Cell> cells() {
  const Vec3 far_corner{100, 200, 300};
  return {{"cube", Box::orthorhombic({10, 10, 10})},
          {"cube far out", Box::orthorhombic({10, 10, 10}, {true, true, true}, far_corner)},
          {"its points may lie below its corner", Box::triclinic({10, -4, 0}, {0, 10, -4}, {-4, 0, 10})},
          {"slab", Box::orthorhombic({10, 10, 10}, {true, false, true})}};
}

/// Places in a cell, by their fractions of its vectors.
std::vector<Vec3> places(const Box& box, const std::vector<Vec3>& fractions) {
  std::vector<Vec3> points;
  for (const Vec3 f : fractions)
    points.push_back(box.origin() + f.x * box.vector(0) + f.y * box.vector(1) + f.z * box.vector(2));
  return points;
}

TEST(StaleTest, TakesFromTheSkinWhatRoundingTakesAndNoMore) {
  std::vector<std::vector<Vec3>> scenes{{{0.9, 0.2, 0.1}, {0.1, 0.8, 0.2}, {0.2, 0.1, 0.7}}};
  for (int axis = 0; axis < 3; ++axis) {  // one that is far along one vector
    scenes.push_back({{0.05, 0.05, 0.05}, {0.02, 0.02, 0.02}});
    scenes.back()[1][axis] = 0.9;
  }
  for (const Cell& cell : cells()) {
    for (const std::vector<Vec3>& fractions : scenes) {
      const std::vector<Vec3> points = places(cell.box, fractions);
      const double skin = least_skin(cell.box, points);
      EXPECT_TRUE(is_kept(skin * (1 + 1e-14), cell.box, points, points)) << cell.name;
      EXPECT_FALSE(is_kept(skin * (1 - 1e-14), cell.box, points, points)) << cell.name;
    }
  }
}

// A cube of side 8 with powers of two for all that is added: nothing rounds here but what is tested.
class StaleTestOfACube : public ::testing::Test {
 protected:
  const Box box_ = Box::orthorhombic({8, 8, 8});
  const WrapError error_{box_};
  const std::vector<Vec3> points_{{1, 1, 1}, {4, 4, 4}};
};

TEST_F(StaleTestOfACube, KeepsListsOfParticlesThatStandStillWithTheLeastSkin) {
  const double skin = least_skin(box_, points_);
  ASSERT_EQ(0.5 * skin - 2 * error_.bound(12), 4 * error_.bound(12));
  EXPECT_TRUE(is_kept(skin, box_, points_, points_));
  EXPECT_FALSE(is_kept(std::nextafter(skin, 0), box_, points_, points_));
}

// Of a particle that comes back many boxes away, the displacement rounds by its own place.
TEST_F(StaleTestOfACube, KeepsListsOfParticlesFarAwayWithTheLeastSkinForTheirPlace) {
  std::vector<Vec3> far = points_;
  far[0] = {1 + 8 * 1024, 1, 1};
  const double left = error_.bound(error_.reach(far[0]) + error_.reach(points_[0]));
  const double skin = 2 * (2 * error_.bound(12) + 2 * left);
  ASSERT_GT(skin, least_skin(box_, points_));
  ASSERT_EQ(0.5 * skin - 2 * error_.bound(12), 2 * left);
  EXPECT_TRUE(is_kept(skin, box_, points_, far));
  EXPECT_FALSE(is_kept(std::nextafter(skin, 0), box_, points_, far));
}

TEST_F(StaleTestOfACube, ComparesPlacesAsGivenWhereThereIsNoSkin) {
  const std::vector<Vec3> outside{{-1, 1, 1}, {4, 4, 12}};
  EXPECT_TRUE(is_kept(0, box_, outside, outside));
  EXPECT_FALSE(is_kept(0, box_, outside, std::vector<Vec3>{{7, 1, 1}, {4, 4, 4}})) << "images of them";
}

}  // namespace
}  // namespace dch
