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

using Verdict = StaleTest::Verdict;

/// Forty particles in a row, of which some have moved since they were remembered.
class StaleTestOfARow : public ::testing::Test {
 protected:
  StaleTestOfARow() {
    for (int k = 0; k < 40; ++k) before_.push_back({0.2 * k, 1, 1});
    now_ = before_;
    test_.remember(before_, box_);
  }
  Verdict judge(std::size_t most = 40) { return test_.judge(now_, box_, most, fast_); }

  const Box box_ = Box::orthorhombic({8, 8, 8});
  StaleTest test_{0.5};
  std::vector<Vec3> before_, now_;
  std::vector<MovedParticle> fast_;
};

TEST_F(StaleTestOfARow, NamesThoseThatHaveMovedMoreThanHalfTheSkinAndHowFar) {
  now_[3].y += 0.2499;
  EXPECT_EQ(judge(), Verdict::fresh);
  EXPECT_TRUE(fast_.empty());
  now_[3].y += 0.0002;
  now_[16].z -= 0.3 + 8 * 5;  // in another image
  now_[39].x += 0.26;
  EXPECT_EQ(judge(), Verdict::some_fast);
  ASSERT_EQ(fast_.size(), 3u);
  const double expected[] = {0.2501, 0.3, 0.26};
  const std::int32_t particles[] = {3, 16, 39};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(fast_[k].particle, particles[k]);
    EXPECT_GE(fast_[k].moved, expected[k]);
    EXPECT_NEAR(fast_[k].moved, expected[k], 1e-11);
  }
  EXPECT_TRUE(test_.is_stale(now_, box_));
}

// The sum of two is by how much pairs may have come closer: each has its share of rounding, which a list of
// particles that stand still has too, with a skin that leaves no more.
TEST_F(StaleTestOfACube, BoundsWhatParticlesMoveWithTheirShareOfRounding) {
  std::vector<Vec3> moved = points_;
  moved[0].x += 1;
  StaleTest test(0.5);
  test.remember(points_, box_);
  std::vector<MovedParticle> fast;
  ASSERT_EQ(test.judge(moved, box_, 2, fast), Verdict::some_fast);
  EXPECT_EQ(fast[0].moved, 1 + 2 * error_.bound(error_.reach(moved[0]) + error_.reach(points_[0])) +
                               2 * error_.bound(error_.reach(points_[1])));
}

TEST_F(StaleTestOfARow, JudgesCandidatesAsItJudgesAll) {
  now_[3].y += 0.3;
  now_[16].z -= 0.26 + 8 * 5;
  now_[20].z += 0.24;
  std::vector<MovedParticle> all;
  ASSERT_EQ(test_.judge(now_, box_, 40, all), Verdict::some_fast);
  const auto judge_of = [&](std::vector<std::int32_t> candidates, std::size_t most) {
    fast_ = {{7, 7}};
    return test_.judge(now_, box_, candidates, most, fast_);
  };
  EXPECT_EQ(judge_of({0, 3, 16, 20, 39}, 2), Verdict::some_fast);
  ASSERT_EQ(fast_.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(fast_[k].particle, all[k].particle);
    EXPECT_EQ(fast_[k].moved, all[k].moved);
  }
  EXPECT_EQ(judge_of({3, 16}, 1), Verdict::too_many);
  EXPECT_EQ(judge_of({0, 20}, 0), Verdict::fresh);
  EXPECT_TRUE(fast_.empty());
  EXPECT_EQ(judge_of({}, 0), Verdict::fresh);
  now_[20].x = std::nan("");
  EXPECT_EQ(judge_of({3, 20}, 2), Verdict::stale);
}

TEST_F(StaleTestOfARow, AllowsNearlyHalfTheSkinInTheBoxOfThen) {
  const double allowed = test_.allowance(40, box_);
  EXPECT_LT(allowed, 0.25);
  EXPECT_NEAR(allowed, 0.25, 1e-10);
  for (Vec3& p : now_) p.y += allowed + 8;
  EXPECT_EQ(judge(), Verdict::fresh);
  EXPECT_LT(test_.allowance(39, box_), 0);
  EXPECT_LT(test_.allowance(40, Box::orthorhombic({8.01, 8, 8})), 0);
  EXPECT_LT(test_.allowance(40, Box::orthorhombic({8, 8, 8}, {true, true, false})), 0);
  StaleTest without(0);
  without.remember(before_, box_);
  EXPECT_LT(without.allowance(40, box_), 0);
  test_.forget();
  EXPECT_LT(test_.allowance(40, box_), 0);
}

// As much is left for rounding as displacements between images far out take.
TEST_F(StaleTestOfACube, AllowsNoMoreThanIsLeftOfRounding) {
  StaleTest test(0.5);
  std::vector<Vec3> far = points_;
  far[0].x += 8 * 1024 * 1024;
  test.remember(far, box_);
  const double of_places = error_.bound(error_.reach(far[0]));
  ASSERT_GT(of_places, 1e-8);
  EXPECT_NEAR(test.allowance(2, box_), 0.25 - 4 * of_places - 16 * error_.bound(12), 1e-13);
}

TEST_F(StaleTestOfARow, SaysWhenThereAreMoreThanAskedFor) {
  for (const int k : {1, 2, 20}) now_[static_cast<std::size_t>(k)].y += 0.3;
  EXPECT_EQ(judge(3), Verdict::some_fast);
  EXPECT_EQ(fast_.size(), 3u);
  EXPECT_EQ(judge(2), Verdict::too_many);
  EXPECT_EQ(judge(0), Verdict::too_many);
  now_ = before_;
  EXPECT_EQ(judge(0), Verdict::fresh);
}

TEST_F(StaleTestOfARow, LeavesWhatIsNoMotionToTheWholeRule) {
  now_[5].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judge(), Verdict::stale);
  now_[5].x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(judge(), Verdict::stale);
  now_ = before_;
  now_[5].x += 0.24;
  const Box longer = Box::orthorhombic({8.01, 8, 8}),
            moved = Box::orthorhombic({8, 8, 8}, {true, true, true}, {1, 0, 0});
  EXPECT_EQ(test_.judge(now_, longer, 40, fast_), Verdict::fresh);
  now_[5].x += 0.02;
  EXPECT_EQ(test_.judge(now_, longer, 40, fast_), Verdict::stale);
  EXPECT_EQ(test_.judge(now_, moved, 40, fast_), Verdict::stale);
  EXPECT_EQ(judge(), Verdict::some_fast);
  now_.pop_back();
  EXPECT_EQ(judge(), Verdict::stale);
  test_.forget();
  EXPECT_EQ(test_.judge(before_, box_, 40, fast_), Verdict::stale);
  StaleTest without(0);
  without.remember(before_, box_);
  EXPECT_EQ(without.judge(before_, box_, 40, fast_), Verdict::fresh);
  now_ = before_;
  now_[0].x += 1e-9;
  EXPECT_EQ(without.judge(now_, box_, 40, fast_), Verdict::stale);
  EXPECT_TRUE(fast_.empty());
}

}  // namespace
}  // namespace dch
