// SPDX-License-Identifier: GPL-2.0-or-later
#include "skin_tuner.h"

#include <cmath>
#include <gtest/gtest.h>

namespace dch::lammps {
namespace {

/// Feeds it lists of `seconds_per_step(skin)` until it has settled; returns how many.
template <class F>
int settle(SkinTuner& tuner, const F& seconds_per_step) {
  int lists = 0;
  for (; !tuner.settled() && lists < 1000; ++lists) tuner.observe(7 * seconds_per_step(tuner.skin()), 7);
  return lists;
}

/// Pairs grow with the cube of the radius, lists become rarer with the skin.
double cost(double skin, double list) { return std::pow(1.0 + skin, 3) + list / skin; }

TEST(SkinTuner, BeginsWithTheLargest) {
  const SkinTuner tuner(0.5);
  EXPECT_EQ(tuner.skin(), 0.5);
  EXPECT_FALSE(tuner.settled());
}

TEST(SkinTuner, FindsASkinNearlyAsFastAsTheBest) {
  for (const double list : {0.01, 0.1, 0.3, 1.0}) {
    SkinTuner tuner(1.0);
    settle(tuner, [&](double skin) { return cost(skin, list); });
    double least = 1e9;
    for (double skin = 0.14; skin <= 1; skin += 0.001) least = std::min(least, cost(skin, list));
    EXPECT_TRUE(tuner.settled());
    EXPECT_LE(cost(tuner.skin(), list), 1.03 * least) << list;
  }
}

TEST(SkinTuner, KeepsTheLargestWhereListsAreDear) {
  SkinTuner tuner(0.4);
  const int lists = settle(tuner, [](double skin) { return cost(skin, 100); });
  EXPECT_EQ(tuner.skin(), 0.4);
  EXPECT_EQ(lists, 15);
}

TEST(SkinTuner, NeverExceedsTheLargestAndNeverReachesZero) {
  SkinTuner tuner(0.3);
  settle(tuner, [&](double skin) {
    EXPECT_LE(skin, 0.3);
    EXPECT_GT(skin, 0.03);
    return skin;
  });
  EXPECT_GT(tuner.skin(), 0.03);
}

TEST(SkinTuner, IsNotMisledByADisturbedListNorByOneOfNoSteps) {
  SkinTuner tuner(1.0);
  int lists = 0;
  while (!tuner.settled()) {
    const double seconds = 7 * cost(tuner.skin(), 0.3);
    tuner.observe(++lists % 5 == 2 ? 10 * seconds : seconds, 7);
    tuner.observe(1e-9, 0);
  }
  EXPECT_NEAR(tuner.skin(), 0.28, 0.08);
}

}  // namespace
}  // namespace dch::lammps
