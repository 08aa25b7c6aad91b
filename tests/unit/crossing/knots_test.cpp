// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <vector>

#include <dch/necklace/crossings.hpp>
#include <dch/necklace/knots.hpp>
#include <dch/necklace/shapes.hpp>

#include "effort.hpp"
#include "random.hpp"

namespace {

using dch::Box;
using dch::Vec3;
using dch::necklace::Chains;
using dch::necklace::CrossingFinder;
using dch::necklace::knot_determinant;
using dch::necklace::linking_number;
using dch::necklace::RingsTouch;
using dch::necklace::torus_knot;
using dch::necklace::writhe;
using dch::scenes::Random;

using Ring = std::vector<Vec3>;
constexpr double kPi = 3.141592653589793;

/// A circle about `center` in the plane of two unit vectors.
Ring circle(int corners, double radius, Vec3 center, Vec3 u, Vec3 v) {
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * kPi * k / corners;
    ring.push_back(center + (radius * std::cos(angle)) * u + (radius * std::sin(angle)) * v);
  }
  return ring;
}

/// Gauss's integral of two segments over 4 pi, by four angles (Klenin and Langowski, Biopolymers 54:307,
/// 2000).
double gauss_integral(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1) {
  const auto unit = [](Vec3 v) { return (1 / std::sqrt(norm2(v))) * v; };
  const Vec3 r13 = b0 - a0, r14 = b1 - a0, r23 = b0 - a1, r24 = b1 - a1;
  const std::array<Vec3, 4> n{unit(cross(r13, r14)), unit(cross(r14, r24)), unit(cross(r24, r23)),
                              unit(cross(r23, r13))};
  double angle = 0;
  for (std::size_t k = 0; k < 4; ++k) angle += std::asin(std::clamp(dot(n[k], n[(k + 1) % 4]), -1.0, 1.0));
  return std::copysign(angle, dot(cross(b1 - b0, a1 - a0), r13)) / (4 * kPi);
}
double gauss_integral(const Ring& a, const Ring& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j)
      sum += gauss_integral(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()]);
  }
  return sum;
}

/// Two rings as one system.
Chains two_rings(std::size_t a, std::size_t b) {
  Chains chains(a + b);
  std::vector<std::int32_t> beads(a + b);
  std::iota(beads.begin(), beads.end(), 0);
  chains.add({beads.data(), a}, true);
  chains.add({beads.data() + a, b}, true);
  return chains;
}

Ring joined(const Ring& a, const Ring& b) {
  Ring result = a;
  result.insert(result.end(), b.begin(), b.end());
  return result;
}

TEST(LinkingNumber, OfAHopfLinkIsOne) {
  const Ring a = circle(17, 1, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Ring b = circle(13, 1, {1, 0, 0}, {1, 0, 0}, {0, 0, 1});
  const std::int64_t linking = linking_number(a, b);
  EXPECT_EQ(std::abs(linking), 1);
  EXPECT_EQ(linking, std::lround(gauss_integral(a, b)));
  EXPECT_EQ(linking_number(b, a), linking);
  EXPECT_EQ(linking_number(a, Ring(b.rbegin(), b.rend())), -linking);
  EXPECT_EQ(linking_number(a, circle(13, 1, {3, 0, 0}, {1, 0, 0}, {0, 0, 1})), 0);
}

TEST(LinkingNumber, OfTorusLinksAndRandomRings) {
  // A ring that winds four times around a circle.
  Ring around;
  for (int k = 0; k < 120; ++k) {
    const double turn = 2 * kPi * k / 120, small = 4 * turn;
    around.push_back({(2 + 0.5 * std::cos(small)) * std::cos(turn),
                      (2 + 0.5 * std::cos(small)) * std::sin(turn), 0.5 * std::sin(small)});
  }
  EXPECT_EQ(std::abs(linking_number(around, circle(60, 2, {}, {1, 0, 0}, {0, 1, 0}))), 4);
  Random random(2);
  int linked = 0;
  for (int k = 0; k < dch::effort(40); ++k) {
    Ring a, b;
    for (int n = 0; n < 8; ++n) a.push_back(random.in_cube(1)), b.push_back(random.in_cube(1));
    const double integral = gauss_integral(a, b);
    EXPECT_NEAR(integral, std::round(integral), 1e-6);
    EXPECT_EQ(linking_number(a, b), std::lround(integral)) << "pair " << k;
    linked += std::lround(integral) != 0 ? 1 : 0;
  }
  EXPECT_GT(linked, 2);
}

TEST(LinkingNumber, RefusesWhatHasNone) {
  const Ring a = circle(4, 1, {}, {1, 0, 0}, {0, 1, 0});
  EXPECT_THROW(linking_number(a, Ring{{0, 0, 0}, {1, 0, 0}}), dch::InvalidParameter);
  EXPECT_THROW(linking_number(a, a), RingsTouch);
  Ring bad = a;
  bad[1].z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(linking_number(a, bad), dch::InvalidPosition);
  EXPECT_THROW(writhe(Ring(2)), dch::InvalidParameter);
  EXPECT_THROW(knot_determinant(Ring(2)), dch::InvalidParameter);
  EXPECT_THROW(knot_determinant(Ring{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, -1, 0}, {0, -1, 0}}),
               RingsTouch);
}

TEST(Writhe, OfPlaneCurvesIsZeroAndOfMirrorImagesOpposite) {
  EXPECT_NEAR(writhe(circle(30, 1, {}, {1, 0, 0}, {0, 1, 0})), 0, 1e-12);
  Ring trefoil = torus_knot(2, 3, 120).positions;
  const double value = writhe(trefoil);
  EXPECT_NEAR(std::abs(value), 3.5, 0.5);  // between 3 and 4 for a trefoil on a torus
  for (Vec3& p : trefoil) p.z = -p.z;
  EXPECT_NEAR(writhe(trefoil), -value, 1e-9);
}

TEST(KnotDeterminant, OfKnownKnots) {
  EXPECT_EQ(knot_determinant(circle(20, 1, {}, {1, 0, 0}, {0, 1, 0})), 1);
  EXPECT_EQ(knot_determinant(torus_knot(1, 5, 80).positions), 1);
  EXPECT_EQ(knot_determinant(torus_knot(2, 3, 60).positions), 3);
  EXPECT_EQ(knot_determinant(torus_knot(3, 2, 60).positions), 3);
  EXPECT_EQ(knot_determinant(torus_knot(2, 5, 100).positions), 5);
  EXPECT_EQ(knot_determinant(torus_knot(3, 4, 120).positions), 3);
  EXPECT_EQ(knot_determinant(torus_knot(2, 31, 600).positions), 31);
  EXPECT_EQ(knot_determinant(torus_knot(3, 5, 160).positions), 1);  // knotted, though
  Ring figure_eight;
  for (int k = 0; k < 90; ++k) {
    const double t = 2 * kPi * k / 90;
    figure_eight.push_back(
        {(2 + std::cos(2 * t)) * std::cos(3 * t), (2 + std::cos(2 * t)) * std::sin(3 * t), std::sin(4 * t)});
  }
  EXPECT_EQ(knot_determinant(figure_eight), 5);
}

/// Rings that turn and fly through each other in several steps: the signs of the crossings of each step add
/// up to the change of the linking number.
TEST(DrivenRings, SignsSumUpToTheChangeOfTheLinkingNumber) {
  Random random(1000);
  int changed = 0, crossings = 0, unseen_at_ends = 0;
  for (int pair = 0; pair < dch::effort(1000); ++pair) {
    const auto random_ring = [&](int corners) {
      const Vec3 u0 = random.in_ball(1), w = random.in_ball(1);
      const Vec3 u = (1 / std::sqrt(norm2(u0))) * u0, v0 = cross(u, w);
      return circle(corners, random.uniform(0.7, 1.5), random.in_cube(0.8), u,
                    (1 / std::sqrt(norm2(v0))) * v0);
    };
    Ring a = random_ring(7 + static_cast<int>(random.below(8))), b = random_ring(5);
    CrossingFinder finder(two_rings(a.size(), b.size()));
    finder.start(joined(a, b), Box::none());
    std::int64_t linking = linking_number(a, b);
    const Vec3 drift = random.in_ball(0.8), turn = random.in_ball(0.5);
    for (int step = 0; step < 4; ++step) {
      for (Vec3& p : b) p = p + drift + cross(turn, p) + random.in_ball(0.2);
      const auto& found = finder.step(joined(a, b), Box::none());
      std::int64_t sum = 0;
      for (const auto& crossing : found.crossings) {
        const bool between = static_cast<std::size_t>(crossing.p) < a.size() &&
                             static_cast<std::size_t>(crossing.q) >= a.size();
        if (between) sum += crossing.sign, ++crossings;
      }
      const std::int64_t now = linking_number(a, b);
      ASSERT_EQ(now - linking, sum) << "pair " << pair << ", step " << step;
      changed += now != linking ? 1 : 0;
      unseen_at_ends += now == linking && sum == 0 && !found.crossings.empty() ? 1 : 0;
      linking = now;
    }
  }
  std::cout << crossings << " crossings, " << changed << " changes, " << unseen_at_ends
            << " steps with crossings that cancel, seed 1000\n";
  EXPECT_GT(changed, dch::effort(1000) / 4);
}

double closest_bonds(const Ring& ring) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    for (std::size_t j = i + 2; j < ring.size(); ++j) {
      for (int u = 0; u < 6; ++u) {
        for (int v = 0; v < 6; ++v) {
          if (i == 0 && j == ring.size() - 1) continue;
          const Vec3 p = ring[i] + (u / 5.0) * (ring[(i + 1) % ring.size()] - ring[i]);
          const Vec3 q = ring[j] + (v / 5.0) * (ring[(j + 1) % ring.size()] - ring[j]);
          least = std::min(least, norm2(p - q));
        }
      }
    }
  }
  return std::sqrt(least);
}

class DrivenKnots : public testing::TestWithParam<std::array<int, 3>> {};

/// A knot that shakes keeps its determinant, without a crossing; drawn out into a circle it loses it, with
/// crossings, though its bonds are apart in every frame.
TEST_P(DrivenKnots, KeepTheirDeterminantUnlessTheyCross) {
  const auto [p, q, determinant] = GetParam();
  const Ring knot = torus_knot(p, q, 40 * q).positions;
  const auto count = static_cast<int>(knot.size());
  Chains chains(knot.size());
  std::vector<std::int32_t> beads(knot.size());
  std::iota(beads.begin(), beads.end(), 0);
  chains.add(beads, true);
  CrossingFinder finder(chains);
  finder.start(knot, Box::none());
  Random random(77);
  for (int step = 0; step < 8; ++step) {
    Ring shaken = knot;
    for (Vec3& bead : shaken) bead = bead + random.in_ball(0.2);
    EXPECT_TRUE(finder.step(shaken, Box::none()).crossings.empty());
    EXPECT_EQ(knot_determinant(shaken), determinant);
  }
  double radius = 0;
  for (const Vec3 bead : knot) radius = std::max(radius, std::sqrt(norm2(bead)));
  Ring unknot = circle(count, radius, {0.3, 0.1, 2 * radius}, {1, 0, 0}, {0, 1, 0});
  for (Vec3& bead : unknot)
    bead = bead + random.in_ball(0.2);  // no symmetry that makes beads meet in a frame
  std::int64_t now = determinant, crossings = 0;
  double closest = std::numeric_limits<double>::infinity();
  finder.start(knot, Box::none());
  constexpr int kSteps = 6;
  for (int step = 1; step <= kSteps; ++step) {
    const double share = static_cast<double>(step) / kSteps;
    Ring between;
    for (std::size_t k = 0; k < knot.size(); ++k)
      between.push_back((1 - share) * knot[k] + share * unknot[k]);
    const auto found = static_cast<std::int64_t>(finder.step(between, Box::none()).crossings.size());
    const std::int64_t next = knot_determinant(between);
    if (next != now) {
      EXPECT_GT(found, 0) << "step " << step;
    }
    closest = std::min(closest, closest_bonds(between));
    crossings += found;
    now = next;
  }
  EXPECT_EQ(now, 1);
  EXPECT_GT(crossings, 0);
  EXPECT_GT(closest, 1e-3);  // no frame shows a contact
  std::cout << crossings << " crossings, closest bonds in a frame " << closest << "\n";
}

INSTANTIATE_TEST_SUITE_P(Knots, DrivenKnots,
                         testing::Values(std::array{2, 3, 3}, std::array{2, 5, 5}, std::array{3, 4, 3}),
                         [](const auto& knot) {
                           return "T" + std::to_string(knot.param[0]) + std::to_string(knot.param[1]);
                         });

}  // namespace
