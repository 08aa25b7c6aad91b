// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/zonotope/gjk.hpp>
#include <dch/zonotope/membership.hpp>
#include <dch/zonotope/norm.hpp>
#include <dch/zonotope/space_time.hpp>

#include "effort.hpp"
#include "random_zonotope.hpp"
#include "zonotope_oracle.hpp"
#include "zonotope_scenes.hpp"

namespace dch::zonotope {
namespace {

using scenes::GeneratorKind;
constexpr int kKinds = static_cast<int>(GeneratorKind::count);

TEST(ZonotopeQueries, PointLocationTakesNLogSquaredN) {
  scenes::Random random(21);
  double least = INFINITY, most = 0, most_rounds = 0;
  for (std::size_t n = 64; n <= 8192; n *= 2) {
    MembershipStats stats;
    const int queries = 8;
    const Zonotope z = random_zonotope(random, n, 0);
    for (int k = 0; k < queries; ++k) {
      const Vec3 direction = random.in_ball(1);
      contains(z, 0.9999 * support_point(z, direction), Method::point_location, &stats);
    }
    const double lg = std::log2(static_cast<double>(n));
    const double operations =
        static_cast<double>(stats.operations) / queries / (static_cast<double>(n) * lg * lg);
    const double rounds = static_cast<double>(stats.rounds) / queries / lg;
    std::printf("n = %zu: %.2f n lg^2 n operations, %.2f lg n rounds\n", n, operations, rounds);
    least = std::min(least, operations);
    most = std::max(most, operations);
    most_rounds = std::max(most_rounds, rounds);
  }
  EXPECT_LT(most, 1.8 * least) << "it grows faster";
  EXPECT_LT(most_rounds, 4);
}

TEST(ZonotopeQueries, TheNormIsWhereTheRayLeaves) {
  scenes::Random random(22);
  for (int n = 0; n < effort(400); ++n) {
    const auto kind = static_cast<GeneratorKind>(n % kKinds);
    const Zonotope z{{}, scenes::grid_generators(random, kind, 8 + random.below(6))};
    Vec3 x = scenes::boundary_point(random, z.generators);
    if (n % 5 == 0) x = random.in_cube(1);
    const double size = norm(z, x);
    if (std::isinf(size)) {
      EXPECT_FALSE(contains(z, 1e-9 * x));
      continue;
    }
    if (size == 0) {
      EXPECT_EQ(x, Vec3{});
      continue;
    }
    EXPECT_NEAR(norm(z, -2.0 * x), 2 * size, 2e-12 * size) << "kind " << n % kKinds;
    if (kind == GeneratorKind::flat || kind == GeneratorKind::segment) continue;  // rounding leads out of it
    EXPECT_TRUE(contains(z, (1 - 1e-11) / size * x)) << "kind " << n % kKinds;
    EXPECT_FALSE(contains(z, (1 + 1e-11) / size * x)) << "kind " << n % kKinds;
  }
  EXPECT_EQ(norm({{9, 9, 9}, {}}, {0, 0, 0}), 0) << "the center does not matter";
  EXPECT_TRUE(std::isinf(norm({{}, {{1, 0, 0}, {0, 1, 0}}}, {0, 0, 1e-300})));
}

TEST(ZonotopeQueries, ThePolyhedralDistanceIsAMetric) {
  scenes::Random random(23);
  const Zonotope z = random_zonotope(random, 7, 1);
  for (int n = 0; n < 100; ++n) {
    const Vec3 p = random.in_cube(1), q = random.in_cube(1), r = random.in_cube(1);
    EXPECT_NEAR(polyhedral_distance(z, p, q), polyhedral_distance(z, q, p), 1e-14);
    EXPECT_LE(polyhedral_distance(z, p, r),
              polyhedral_distance(z, p, q) + polyhedral_distance(z, q, r) + 1e-13);
  }
}

TEST(ZonotopeQueries, DistancesAreThoseOfAllDirections) {
  scenes::Random random(24);
  int apart = 0, iterations = 0;
  const int trials = effort(2000);
  for (int n = 0; n < trials; ++n) {
    const Zonotope a = random_zonotope(random, random.below(10), 1),
                   b = random_zonotope(random, random.below(10), 8);
    const Separation found = distance(a, b);
    iterations += found.iterations;
    EXPECT_NEAR(std::sqrt(norm2(found.point_a - found.point_b)), found.distance, 1e-12);
    EXPECT_TRUE(norm(a, (1 - 1e-9) * (found.point_a - a.center)) <= 1 || a.generators.size() < 3);
    EXPECT_EQ(found.distance > 0, !intersect(a, b));
    if (found.distance == 0) continue;
    ++apart;
    // Both bounds: the points are that far apart, and along the direction so are the zonotopes.
    const double gap = -support(a, found.direction) - support(b, -1.0 * found.direction);
    EXPECT_NEAR(gap, found.distance, 1e-11 * found.distance + 1e-13);
    EXPECT_NEAR(found.lower_bound, found.distance, 1e-11 * found.distance + 1e-13);
    const Separation again = distance(a, b, found.direction);
    EXPECT_NEAR(again.distance, found.distance, 1e-11);
  }
  std::printf("%d of %d apart, %.1f iterations on average\n", apart, trials, 1.0 * iterations / trials);
  EXPECT_GT(apart, trials / 3);
  EXPECT_LT(iterations, 20 * trials);
}

TEST(ZonotopeQueries, GjkFollowsSmallMotionsInFewIterations) {
  scenes::Random random(25);
  const Zonotope a = random_zonotope(random, 40, 0);
  Zonotope b = random_zonotope(random, 40, 0);
  Separation last;
  int cold = 0, warm = 0;
  for (int step = 0; step < 200; ++step) {
    const double angle = 0.001 * step;
    b.center = {60 * std::cos(angle), 60 * std::sin(angle), 3};
    const Separation from_nothing = distance(a, b), from_last = distance(a, b, last.direction);
    EXPECT_NEAR(from_nothing.distance, from_last.distance, 1e-10);
    cold += from_nothing.iterations;
    warm += from_last.iterations;
    last = from_last;
  }
  std::printf("iterations: %d from the centers, %d from the step before\n", cold, warm);
  EXPECT_LT(warm, cold);
}

TEST(ZonotopeQueries, EnclosureIsThatOfIntegers) {
  constexpr int kQueryBits = 64;
  scenes::Random random(26);
  int wrong = 0, enclosed = 0;
  const int trials = std::getenv("DCH_TEST_LONG") != nullptr ? 100000 : effort(4000);
  for (int n = 0; n < trials; ++n) {
    const auto kind = static_cast<GeneratorKind>(n % kKinds);
    const std::vector<Vec3> inner = scenes::grid_generators(random, kind, 1 + random.below(4));
    // Half of it twice over: the same zonotope; with one generator changed by a grid step: larger or not.
    std::vector<Vec3> outer;
    for (const Vec3& v : inner)
      for (int half = 0; half < 2; ++half) outer.push_back(0.5 * v);
    const std::size_t changed = random.below(outer.size());
    if (n % 3 != 0) outer[changed] = (1 + (n % 3 == 1 ? 0x1p-30 : -0x1p-30)) * outer[changed];
    if (n % 7 == 0) outer.push_back(scenes::on_grid(random.in_cube(1e-3), 40));
    const Vec3 shift = n % 4 == 0 ? scenes::on_grid(random.in_cube(1e-6), 40) : Vec3{};
    const oracle::ZonotopeOracle oracle(outer, kQueryBits);
    bool expected = true;
    for (unsigned signs = 0; signs < 1u << inner.size(); ++signs) {
      oracle::IntegerVec vertex = oracle::scaled(shift, kQueryBits);
      for (std::size_t k = 0; k < inner.size(); ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
          vertex[axis] += (signs >> k & 1u ? 1 : -1) * oracle::scaled(inner[k], kQueryBits)[axis];
      expected = expected && oracle.side(vertex) >= 0;
    }
    const Vec3 center{1, 2, 3};
    wrong += encloses({center, outer}, {center + shift, inner}) != expected;
    enclosed += expected;
  }
  std::printf("%d of %d enclosed, %d wrong answers\n", enclosed, trials, wrong);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(enclosed, trials / 5);
  EXPECT_LT(enclosed, trials);
}

TEST(ZonotopeQueries, SweptVolumesHoldTheBodyAtAllTimes) {
  scenes::Random random(27);
  double generators = 0, needed = 0;
  for (int n = 0; n < effort(60); ++n) {
    const Zonotope body = random_zonotope(random, 1 + random.below(8), 1);
    RigidMotion motion{random.in_cube(2), random.in_cube(1), random.in_ball(1), random.uniform(-3.1, 3.1)};
    if (n % 3 == 0) motion.angle = 0;
    if (n % 3 == 1) motion.translation = {};
    const double from = random.uniform(0, 0.5), to = random.uniform(0.5, 1);
    const Zonotope swept = swept_volume(body, motion, from, to);
    EXPECT_LE(swept.generators.size(), body.generators.size() + 3);
    for (int k = 0; k <= 20; ++k) {
      const Zonotope now = placed(body, motion, from + (to - from) * k / 20);
      // Rounding of the placement aside, which is not the volume's matter.
      for (int d = 0; d < 50; ++d) {
        const Vec3 direction = random.in_ball(1);
        EXPECT_LE(support(now, direction), support(swept, direction) + 1e-13) << n;
      }
    }
    generators += static_cast<double>(swept.generators.size());
    needed += 1;
  }
  EXPECT_GT(generators, needed);
}

TEST(ZonotopeQueries, BisectionAgreesWithManyPlacements) {
  scenes::Random random(28);
  int met = 0, apart = 0;
  std::int64_t intervals = 0;
  const int trials = effort(150);
  for (int n = 0; n < trials; ++n) {
    const Zonotope a = random_zonotope(random, 4, 2), b = random_zonotope(random, 4, 6);
    const RigidMotion of_a{random.in_cube(6), a.center, random.in_ball(1), random.uniform(-2, 2)};
    const RigidMotion of_b{random.in_cube(6), b.center, random.in_ball(1), random.uniform(-4, 4)};
    const FirstMeeting found = first_meeting(a, of_a, b, of_b, 1e-4);
    intervals += found.intervals;
    double seen = 2;
    for (int k = 0; k <= 500 && seen > 1; ++k)
      if (intersect(placed(a, of_a, k / 500.0), placed(b, of_b, k / 500.0))) seen = k / 500.0;
    if (seen <= 1) {
      ASSERT_NE(found.outcome, Meeting::none) << n;
      EXPECT_LE(found.from, seen);
    }
    if (found.outcome == Meeting::contact) {
      EXPECT_TRUE(intersect(placed(a, of_a, found.to), placed(b, of_b, found.to)));
      EXPECT_LE(found.to, seen + 1e-4);
    }
    met += found.outcome == Meeting::contact;
    apart += found.outcome == Meeting::none;
  }
  std::printf("%d meet, %d do not, of %d; %.1f intervals on average\n", met, apart, trials,
              static_cast<double>(intervals) / trials);
  EXPECT_GT(met, trials / 10);
  EXPECT_GT(apart, trials / 10);
}

}  // namespace
}  // namespace dch::zonotope
