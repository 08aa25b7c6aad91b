// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <set>
#include <tuple>
#include <vector>

#include <dch/necklace/shapes.hpp>
#include <dch/necklace/walks.hpp>

#include "error_message.hpp"

namespace {

using dch::InvalidParameter;
using dch::Vec3;
using dch::necklace::Shape;
using dch::test::message_of;
using testing::HasSubstr;

double bond(const Shape& shape, std::size_t k) {
  const std::size_t next = (k + 1) % shape.positions.size();
  return std::sqrt(norm2(shape.positions[next] - shape.positions[k]));
}

/// Smallest distance of two beads with more than `skip` bonds between them.
double closest(const Shape& shape, std::size_t skip) {
  double least = INFINITY;
  const std::size_t n = shape.positions.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const std::size_t bonds = shape.closed ? std::min(j - i, n + i - j) : j - i;
      if (bonds > skip) least = std::min(least, norm2(shape.positions[j] - shape.positions[i]));
    }
  }
  return std::sqrt(least);
}

TEST(Shapes, GridNecklacesVisitEachPointOnceByUnitSteps) {
  for (const auto& [nx, ny, nz] : {std::tuple{1, 1, 1}, {5, 1, 1}, {4, 3, 1}, {3, 4, 5}, {4, 3, 2}}) {
    const Shape grid = dch::necklace::grid_necklace(nx, ny, nz);
    ASSERT_EQ(grid.positions.size(), static_cast<std::size_t>(nx * ny * nz));
    std::set<std::tuple<double, double, double>> points;
    for (const Vec3& p : grid.positions) {
      EXPECT_TRUE(p.x >= 0 && p.x < nx && p.y >= 0 && p.y < ny && p.z >= 0 && p.z < nz);
      points.insert({p.x, p.y, p.z});
    }
    EXPECT_EQ(points.size(), grid.positions.size());
    for (std::size_t k = 0; k + 1 < grid.positions.size(); ++k) EXPECT_EQ(bond(grid, k), 1);
  }
}

TEST(Shapes, HelixKeepsItsRadiusAndRise) {
  const Shape shape = dch::necklace::helix(100, 3.2, 0.3, 0.06);
  for (std::size_t k = 0; k < 100; ++k) {
    EXPECT_NEAR(std::hypot(shape.positions[k].x, shape.positions[k].y), 3.2, 1e-14);
    EXPECT_NEAR(shape.positions[k].z, 0.06 * double(k), 1e-13);
  }
}

TEST(Shapes, TorusKnotsHaveEvenBondsAndNoContact) {
  for (const auto& [p, q] : {std::pair{2, 3}, {3, 2}, {2, 5}, {3, 4}}) {
    const Shape knot = dch::necklace::torus_knot(p, q, 200);
    EXPECT_TRUE(knot.closed);
    for (std::size_t k = 0; k < 200; ++k) EXPECT_NEAR(bond(knot, k), 1, 0.01) << "T(" << p << "," << q << ")";
    EXPECT_GT(closest(knot, 2), 1.5);
  }
  EXPECT_GT(closest(dch::necklace::torus_knot(2, 3, 60), 1), 1);
}

TEST(Shapes, BumpsFaceEachOtherAndPassBy) {
  for (const double progress : {0.0, 0.3, 0.5, 1.0}) {
    const Shape shape = dch::necklace::facing_bumps(60, 3, 0.4, progress);
    EXPECT_EQ(shape.positions.size(), 602U);
    for (std::size_t k = 0; k + 1 < shape.positions.size(); ++k) {
      EXPECT_NEAR(bond(shape, k), 1, 0.03) << "bond " << k << " at " << progress;
    }
    const double distance = closest(shape, 1);
    EXPECT_GE(distance, 0.4 - 1e-9);
    if (progress == 0.5) {
      EXPECT_NEAR(distance, 0.4, 1e-9) << "tops are opposite to one another";
    }
  }
  const Shape begin = dch::necklace::facing_bumps(60, 3, 0.4, 0),
              end = dch::necklace::facing_bumps(60, 3, 0.4, 1);
  EXPECT_NEAR(begin.positions.back().x - end.positions.back().x, 120, 1e-9);
  EXPECT_EQ(begin.positions.front(), end.positions.front());
}

TEST(Shapes, TightSetLiesOnTheUnitCircle) {
  const Shape set = dch::necklace::tight_set(6);
  ASSERT_EQ(set.positions.size(), 64U);
  for (const Vec3& p : set.positions) EXPECT_NEAR(norm2(p), 1, 1e-13);
  EXPECT_EQ(dch::necklace::tight_set(0).positions.size(), 1U);
}

TEST(Walks, AreTheSameForTheSameSeed) {
  EXPECT_EQ(dch::necklace::random_walk(50, 3).positions, dch::necklace::random_walk(50, 3).positions);
  EXPECT_NE(dch::necklace::random_walk(50, 3).positions, dch::necklace::random_walk(50, 4).positions);
  EXPECT_EQ(dch::necklace::globule(50, 0.1, 3).positions, dch::necklace::globule(50, 0.1, 3).positions);
}

TEST(Walks, RandomWalkHasUnitBonds) {
  const Shape walk = dch::necklace::random_walk(1000, 1);
  for (std::size_t k = 0; k < 999; ++k) EXPECT_NEAR(bond(walk, k), 1, 1e-12);
  EXPECT_TRUE(dch::necklace::random_walk(0, 1).positions.empty());
}

TEST(Walks, GlobuleFillsACube) {
  const Shape exact = dch::necklace::globule(512, 0, 1);
  for (std::size_t k = 0; k < 511; ++k) EXPECT_EQ(bond(exact, k), 1) << "bead " << k;
  EXPECT_EQ(closest(exact, 0), 1);
  for (const Vec3& p : exact.positions) EXPECT_TRUE(p.x <= 7 && p.y <= 7 && p.z <= 7);
  const Shape shaken = dch::necklace::globule(300, 0.1, 1);
  for (std::size_t k = 0; k < 299; ++k) EXPECT_NEAR(bond(shaken, k), 1, 0.35);
}

TEST(Walks, SelfAvoidingWalkKeepsItsBeadsApart) {
  for (const double diameter : {0.5, 1.0}) {
    const Shape walk = dch::necklace::self_avoiding_walk(1000, diameter, 2);
    ASSERT_EQ(walk.positions.size(), 1000U);
    for (std::size_t k = 0; k < 999; ++k) EXPECT_NEAR(bond(walk, k), 1, 1e-12);
    EXPECT_GE(closest(walk, 1), diameter * (1 - 1e-11));
  }
  const Shape walk = dch::necklace::self_avoiding_walk(64, 1, 2);
  EXPECT_EQ(walk.positions, dch::necklace::self_avoiding_walk(64, 1, 2).positions);
  for (const std::int32_t beads : {0, 1, 2, 3}) {
    EXPECT_EQ(dch::necklace::self_avoiding_walk(beads, 1, 2).positions.size(),
              static_cast<std::size_t>(beads));
  }
}

TEST(Walks, SelfAvoidingWalkIsSwollen) {
  // The end-to-end distance grows as n^0.588: its mean square over 64 walks of 500 beads is far above 499.
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 64; ++seed) {
    sum += norm2(dch::necklace::self_avoiding_walk(500, 1, seed).positions.back());
  }
  EXPECT_GT(sum / 64, 1.5 * 499);
}

TEST(Shapes, RefuseParametersOutOfRange) {
  const auto error = [](auto call) { return message_of<InvalidParameter>(call); };
  using namespace dch::necklace;
  EXPECT_THAT(error([] { grid_necklace(0, 1, 1); }), HasSubstr("the grid is 0 x 1 x 1"));
  EXPECT_THAT(error([] { grid_necklace(2000, 2000, 2000); }), HasSubstr("2^31 - 1"));
  EXPECT_THAT(error([] { helix(-1, 1, 1, 1); }), HasSubstr("a helix of -1 beads"));
  EXPECT_THAT(error([] { helix(1, INFINITY, 1, 1); }), HasSubstr("radius inf"));
  EXPECT_THAT(error([] { torus_knot(2, 4, 100); }), HasSubstr("T(2, 4) is no knot"));
  EXPECT_THAT(error([] { torus_knot(2, 3, 2); }), HasSubstr("a knot of 2 beads"));
  EXPECT_THAT(error([] { facing_bumps(60, 7, 0.4, 0); }), HasSubstr("bumps of height 7"));
  EXPECT_THAT(error([] { facing_bumps(60, 3, 0, 0); }), HasSubstr("the gap is 0"));
  EXPECT_THAT(error([] { facing_bumps(60, 3, 0.4, 2); }), HasSubstr("progress is 2"));
  EXPECT_THAT(error([] { tight_set(25); }), HasSubstr("k is 25"));
  EXPECT_THAT(error([] { random_walk(-1, 1); }), HasSubstr("a walk of -1 beads"));
  EXPECT_THAT(error([] { self_avoiding_walk(-1, 1, 1); }), HasSubstr("a walk of -1 beads"));
  EXPECT_THAT(error([] { self_avoiding_walk(10, 1.1, 1); }), HasSubstr("the diameter is 1.1"));
  EXPECT_THAT(error([] { globule(-1, 0, 1); }), HasSubstr("a walk of -1 beads"));
  EXPECT_THAT(error([] { globule(10, 0.6, 1); }), HasSubstr("jitter is 0.6"));
}

}  // namespace
