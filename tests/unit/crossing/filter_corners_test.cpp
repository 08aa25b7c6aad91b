// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include <dch/necklace/crossings.hpp>

#include "random.hpp"

namespace {

using dch::Box;
using dch::IndexPair;
using dch::Vec3;
using dch::necklace::CrossingFinder;
using dch::scenes::Random;

constexpr std::uint64_t kCornerSeed = 20261125;
const std::vector<IndexPair> kTwoBonds{{0, 1}, {2, 3}};

/// A bond about its middle: middle + s along + t motion + s t twist, s and t from -1 to 1.
struct Shape {
  Vec3 middle, along, motion, twist;

  Vec3 at(double s, double t) const { return middle + s * along + t * motion + (s * t) * twist; }
};

/// Crossings near a corner of the parallelepiped of the filter: at the ends of both bonds and of the step,
/// with all five generators to one side along an axis, of which one is the largest. A filter that takes one
/// of them for shorter loses the crossing.
TEST(FilterCorners, CrossingsAtTheCornersOfTheFilterAreFound) {
  Random random(kCornerSeed);
  constexpr double kCorner = 0.98;
  for (int n = 0; n < 600; ++n) {
    const int axis = n % 3, largest = n / 3 % 5;
    const auto generator = [&](int k) {
      Vec3 g = random.in_cube(0.15);
      g[axis] = k == largest ? 0.6 : 0.04;
      return g;
    };
    Shape p{{}, generator(0), generator(2), generator(3)};
    Shape q{{}, generator(1), {}, generator(4)};
    // At s = corner of p, s = -corner of q and t = corner both are at one point.
    q.middle = p.at(kCorner, kCorner) - q.at(-kCorner, kCorner);
    const auto frame = [&](double t) {
      return std::vector<Vec3>{p.at(-1, t), p.at(1, t), q.at(-1, t), q.at(1, t)};
    };
    const std::array<std::vector<Vec3>, 2> frames{frame(-1), frame(1)};
    CrossingFinder finder(4, kTwoBonds);
    finder.start(frames[0], Box::none());
    const auto& found = finder.step(frames[1], Box::none());
    bool is_there = false;
    for (const auto& crossing : found.crossings) {
      is_there |= std::abs(crossing.time - 0.5 * (1 + kCorner)) < 1e-6 &&
                  std::abs(crossing.on_p - 0.5 * (1 + kCorner)) < 1e-6;
    }
    EXPECT_TRUE(is_there) << "axis " << axis << ", generator " << largest << ", " << n;
    EXPECT_EQ(found.stats.by_ball + found.stats.by_box + found.stats.by_zonotope, 0);
  }
}

/// Bonds side by side that stay a little less than the thickness apart, along each axis.
TEST(FilterCorners, ContactsAtTheThicknessPassTheFilters) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along, by;
    along[(axis + 1) % 3] = 0.5;
    by[axis] = 0.2999;
    dch::necklace::CrossingFinderParams params;
    params.thickness = 0.3;
    CrossingFinder finder(4, kTwoBonds, params);
    const std::vector<Vec3> at{-1.0 * along, along, by - along, by + along};
    finder.start(at, Box::none());
    EXPECT_EQ(finder.step(at, Box::none()).contacts.size(), 1U) << axis;
  }
}

}  // namespace
