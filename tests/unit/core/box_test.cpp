// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/geometry/box.hpp>

#include "scenes.hpp"
#include "special_numbers.hpp"

namespace dch {
namespace {

using scenes::Random;
using ::testing::HasSubstr;

double norm(Vec3 v) { return std::sqrt(norm2(v)); }
Vec3 operator-(Vec3 v) { return -1.0 * v; }

template <class E, class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const E& error) {
    return error.what();
  }
  return "nothing thrown";
}

/// A lattice of random shape; the cell is skewed by adding up to `skew` multiples of one vector to another.
Box random_box(Random& random, double skew, Box::Periodic periodic) {
  for (;;) {
    Vec3 a = random.in_cube(5), b = random.in_cube(5), c = random.in_cube(5);
    if (std::abs(dot(a, cross(b, c))) < 0.1 * norm(a) * norm(b) * norm(c)) continue;
    b = b + std::nearbyint(random.uniform(-skew, skew)) * a;
    c = c + std::nearbyint(random.uniform(-skew, skew)) * a;
    c = c + std::nearbyint(random.uniform(-skew, skew)) * b;
    return Box::triclinic(a, b, c, periodic);
  }
}

Box::Periodic periodicity(int bits) { return {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0}; }

/// Shortest of d + n_1 v_1 + n_2 v_2 + n_3 v_3 with n_k from -reach to reach around the image that rounding
/// gives.
double shortest_by_force(Vec3 d, const Box& box, int reach) {
  const auto& v = box.reduced();
  for (int k = 0; k < box.rank(); ++k) d = d - std::floor(dot(box.reduced_dual()[k], d)) * v[k];
  const auto range = [&](int k) { return k < box.rank() ? reach : 0; };
  double shortest2 = kInfinity;
  for (int i = -range(0); i <= range(0); ++i) {
    for (int j = -range(1); j <= range(1); ++j) {
      for (int k = -range(2); k <= range(2); ++k) {
        shortest2 = std::min(shortest2, norm2(d + double(i) * v[0] + double(j) * v[1] + double(k) * v[2]));
      }
    }
  }
  return std::sqrt(shortest2);
}

TEST(Box, NoneHasNoImages) {
  const Box box;
  EXPECT_EQ(box.kind(), Box::Kind::none);
  EXPECT_EQ(box.description(), "none");
  EXPECT_FALSE(box.any_periodic());
  EXPECT_EQ(box.min_height(), kInfinity);
  EXPECT_EQ(box.max_distance(), kInfinity);
  EXPECT_EQ(box.shortest_period(), kInfinity);
  EXPECT_EQ(box.volume(), 0);
  const Vec3 far{1e100, -1e100, 1};
  EXPECT_EQ(box.nearest_image(far), far);
  EXPECT_EQ(box.wrap(far), far);
  EXPECT_EQ(box.fractional(far), far);
}

TEST(Box, OrthorhombicNearestImages) {
  const Box box = Box::orthorhombic({10, 20, 30}, {true, true, false});
  EXPECT_EQ(box.description(), "orthorhombic ppf");
  EXPECT_EQ(box.nearest_image({6, -11, 100}), (Vec3{-4, 9, 100}));
  EXPECT_EQ(box.nearest_image({5, -10, 0}), (Vec3{5, -10, 0})) << "ties stay as they are";
  EXPECT_EQ(box.nearest_image({1e7 + 3, 0, 0}), (Vec3{3, 0, 0})) << "a million boxes away";
  EXPECT_EQ(box.min_height(), 10);
  EXPECT_EQ(box.max_cutoff(), 5);
  EXPECT_EQ(box.volume(), 6000);
  EXPECT_EQ(box.max_distance(), kInfinity) << "one axis is open";
  EXPECT_DOUBLE_EQ(Box::orthorhombic({6, 8, 24}).max_distance(), 13);
}

TEST(Box, NearestImagesAreNearestInAnyLattice) {
  Random random(1);
  for (int trial = 0; trial < 600; ++trial) {
    const double skew = trial % 3 == 0 ? 0 : trial % 3 == 1 ? 5 : 300;
    const Box box = random_box(random, skew, periodicity(1 + trial % 7));
    for (int k = 0; k < 20; ++k) {
      const Vec3 d = random.in_cube(k % 2 == 0 ? 5 : 50);
      const double expected = shortest_by_force(d, box, 4);
      ASSERT_NEAR(norm(box.nearest_image(d)), expected, 1e-9) << "trial " << trial << ", displacement " << k;
      ASSERT_LE(norm(box.nearest_image(d)), norm(d) * (1 + 1e-15));
    }
  }
}

TEST(Box, ExtremeSkewIsReducedToTheSameLattice) {
  for (const double skew : {1e2, 1e4, 1e6}) {
    const Vec3 a{3, 0, 0}, b{1, 4, 0}, c{1, 1, 5};
    const Box plain = Box::triclinic(a, b, c);
    const Box skewed = Box::triclinic(a, b + skew * a, c - skew * a);
    EXPECT_NEAR(skewed.min_height(), plain.min_height(), 1e-15 * skew);
    Random random(2);
    for (int k = 0; k < 200; ++k) {
      const Vec3 d = random.in_cube(10);
      EXPECT_NEAR(norm(skewed.nearest_image(d)), norm(plain.nearest_image(d)), 1e-14 * skew);
    }
  }
}

TEST(Box, NearestImageIsExactlyAntisymmetric) {
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const Box box =
        trial % 4 == 0 ? Box::orthorhombic({3, 4, 5}) : random_box(random, 10, periodicity(1 + trial % 7));
    for (int k = 0; k < 20; ++k) {
      const Vec3 d = random.in_cube(k % 2 == 0 ? 8 : 1e6);
      ASSERT_EQ(box.nearest_image(-d), -box.nearest_image(d));
    }
    // Halves of lattice vectors have several nearest images.
    for (const Vec3 v : box.relevant()) ASSERT_EQ(box.nearest_image(-0.5 * v), -box.nearest_image(0.5 * v));
  }
}

TEST(Box, DistanceIsAMetric) {
  Random random(4);
  for (const auto& [name, box] : scenes::all_boxes(5)) {
    for (int trial = 0; trial < 2000; ++trial) {
      const Vec3 p = random.in_cube(10), q = random.in_cube(10), r = random.in_cube(10);
      ASSERT_EQ(box.distance2(p, q), box.distance2(q, p)) << name;
      ASSERT_LE(std::sqrt(box.distance2(p, r)),
                std::sqrt(box.distance2(p, q)) + std::sqrt(box.distance2(q, r)) + 1e-12)
          << name;
      ASSERT_LE(std::sqrt(box.distance2(p, q)), box.max_distance()) << name;
    }
  }
}

TEST(Box, DisplacementsOfManyBoxes) {
  Random random(5);
  for (const auto& [name, box] : scenes::all_boxes(5)) {
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3 d = random.in_cube(3);
      Vec3 far = d;
      for (int k = 0; k < box.rank(); ++k)
        far = far + std::nearbyint(random.uniform(-1e6, 1e6)) * box.reduced()[k];
      ASSERT_NEAR(norm(box.nearest_image(far)), norm(box.nearest_image(d)), 1e-7) << name;
    }
    EXPECT_TRUE(std::isfinite(norm2(box.nearest_image({1e100, -1e100, 1e99})))) << name;
  }
}

TEST(Box, ReducedBasisIsObtuseAndSpansTheLattice) {
  Random random(6);
  for (int trial = 0; trial < 300; ++trial) {
    const Box box = random_box(random, 20, {true, true, true});
    const auto& v = box.reduced();
    const Vec3 last = -(v[0] + v[1] + v[2]);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(dot(v[i], last), 1e-9);
      for (int j = 0; j < i; ++j) EXPECT_LE(dot(v[i], v[j]), 1e-9);
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(dot(v[i], box.reduced_dual()[j]), i == j ? 1 : 0, 1e-12);
    }
    EXPECT_NEAR(std::abs(dot(v[0], cross(v[1], v[2]))), box.volume(), 1e-9 * box.volume());
    // Integer coordinates in the cell as given.
    for (int i = 0; i < 3; ++i) {
      const Vec3 n = box.fractional(v[i]);
      for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(n[axis], std::nearbyint(n[axis]), 1e-9);
    }
    for (int k = 0; k < 3; ++k) EXPECT_GE(1 / norm(box.reduced_dual()[k]), box.min_height() * (1 - 1e-12));
    EXPECT_GE(box.shortest_period(), box.min_height() * (1 - 1e-12));
  }
}

TEST(Box, HeightsOfAPartlyPeriodicCellAreThoseWithinTheSpan) {
  const Box box = Box::triclinic({4, 0, 0}, {1, 3, 0}, {2, 2, 1}, {true, true, false});
  EXPECT_EQ(box.rank(), 2);
  EXPECT_NEAR(box.min_height(), 12 / std::sqrt(16.0), 1e-12)
      << "area 12 over the longer vector, not the height 1 of c";
  EXPECT_NEAR(Box::triclinic({3, 4, 0}, {0, 1, 0}, {0, 0, 1}, {true, false, false}).min_height(), 5, 1e-12);
}

TEST(Box, TinyTiltsAreOrthorhombic) {
  EXPECT_EQ(Box::triclinic({10, 0, 0}, {1e-17, 10, 0}, {-1e-15, 1e-17, 10}), Box::orthorhombic({10, 10, 10}));
  EXPECT_EQ(Box::triclinic({10, 0, 0}, {1e-8, 10, 0}, {0, 0, 10}).kind(), Box::Kind::triclinic);
  EXPECT_EQ(Box::triclinic({-10, 0, 0}, {0, 10, 0}, {0, 0, 10}).kind(), Box::Kind::triclinic);
}

TEST(Box, ALatticeIsTheSameInAnyCell) {
  // A cubic lattice in a skewed cell, and with its axes in another order and sense.
  const Box cubic = Box::orthorhombic({4, 4, 4});
  const Box skewed = Box::triclinic({4, 0, 0}, {40, 4, 0}, {-80, 12, 4});
  const Box turned = Box::triclinic({0, -4, 0}, {0, 0, 4}, {4, 0, 0});
  Random random(7);
  for (int k = 0; k < 500; ++k) {
    const Vec3 d = random.in_cube(9);
    EXPECT_DOUBLE_EQ(norm(skewed.nearest_image(d)), norm(cubic.nearest_image(d)));
    EXPECT_DOUBLE_EQ(norm(turned.nearest_image(d)), norm(cubic.nearest_image(d)));
  }
  EXPECT_EQ(skewed.min_height(), 4);
  EXPECT_EQ(turned.min_height(), 4);
}

TEST(Box, WrapPutsPointsIntoTheCell) {
  Random random(8);
  for (const auto& [name, box] : scenes::all_boxes(5)) {
    for (const auto& set : scenes::hard_point_sets(box, 200, 0.5)) {
      for (const Vec3 p : set.points) {
        const Vec3 w = box.wrap(p);
        const double rounding = 1e-14 * (norm(p) + 100);
        EXPECT_LE(box.distance2(p, w), rounding * rounding) << name << ", " << set.name;
        for (int k = 0; k < box.rank(); ++k) {
          const double f = dot(box.reduced_dual()[k], w - box.origin());
          EXPECT_GE(f, -1e-13) << name << ", " << set.name;
          EXPECT_LE(f, 1 + 1e-13) << name << ", " << set.name;
        }
      }
    }
  }
  const Box box = Box::orthorhombic({10, 10, 10}, {true, true, false}, {-5, 0, 0});
  EXPECT_EQ(box.wrap({5, 10, 10}), (Vec3{-5, 0, 10})) << "the far face is the near one";
  EXPECT_EQ(box.wrap({0, -1e-17, -1}), (Vec3{0, 0, -1})) << "never on the far face";
  EXPECT_EQ(box.wrap({-5, 9.5, 0}), (Vec3{-5, 9.5, 0}));
}

TEST(Box, FractionalCoordinates) {
  const Box box = Box::triclinic({4, 0, 0}, {1, 3, 0}, {2, 2, 5}, {true, false, true}, {1, 1, 1});
  const Vec3 f =
      box.fractional(Vec3{1, 1, 1} + 0.25 * box.vector(0) - 2.0 * box.vector(1) + 0.5 * box.vector(2));
  EXPECT_NEAR(f.x, 0.25, 1e-14);
  EXPECT_NEAR(f.y, -2, 1e-14);
  EXPECT_NEAR(f.z, 0.5, 1e-14);
}

TEST(Box, EqualityLooksAtKindPeriodicityCellAndOrigin) {
  const Box box = Box::orthorhombic({1, 2, 3});
  EXPECT_EQ(box, Box::orthorhombic({1, 2, 3}));
  EXPECT_NE(box, Box::orthorhombic({1, 2, 4}));
  EXPECT_NE(box, Box::orthorhombic({1, 2, 3}, {true, true, false}));
  EXPECT_NE(box, Box::orthorhombic({1, 2, 3}, {true, true, true}, {1, 0, 0}));
  EXPECT_NE(box, Box::none());
}

TEST(Box, BadCellsAreRefusedByName) {
  for (const double bad : {0.0, kNaN, kInfinity, 1e-101, 1e101}) {
    EXPECT_THROW(Box::orthorhombic({1, bad, 1}), InvalidBox) << bad;
    EXPECT_THROW(Box::orthorhombic({1, bad, 1}, {true, false, true}), InvalidBox) << bad;
    EXPECT_THROW(Box::triclinic({1, 0, 0}, {0, bad, 0}, {0, 0, 1}), InvalidBox) << bad;
  }
  EXPECT_THROW(Box::orthorhombic({1, 1, -1}), InvalidBox);
  EXPECT_THROW(Box::orthorhombic({1, 1, 1}, {true, true, true}, {kNaN, 0, 0}), InvalidBox);
  EXPECT_THROW(Box::triclinic({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {true, true, true}, {0, 1e101, 0}),
               InvalidBox);
  EXPECT_THROW(Box::triclinic({1, 2, 3}, {2, 4, 6}, {0, 0, 1}), InvalidBox);
  EXPECT_THROW(Box::triclinic({1, 0, 0}, {0, 1, 0}, {1, 1, 1e-13}), InvalidBox);

  EXPECT_THAT(message_of<InvalidBox>([] {
                Box::orthorhombic({1, -2.5, 1});
              }),
              ::testing::AllOf(HasSubstr("along y"), HasSubstr("-2.5"), HasSubstr("Box::none()")));
  EXPECT_THAT(message_of<InvalidBox>([] {
                Box::triclinic({1, 0, 0}, {0, 0, 0}, {0, 0, 1});
              }),
              HasSubstr("cell vector b = (0, 0, 0)"));
  EXPECT_THAT(message_of<InvalidBox>([] {
                Box::triclinic({1, 0, 0}, {0, 1, 0}, {1, 1, 0});
              }),
              HasSubstr("linearly dependent"));
}

}  // namespace
}  // namespace dch
