// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <string>
#include <vector>

#include <dch/necklace/layered_hierarchy.hpp>
#include <dch/necklace/shapes.hpp>
#include <dch/necklace/walks.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "cage_check.hpp"
#include "effort.hpp"
#include "error_message.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace {

using dch::Box;
using dch::InvalidParameter;
using dch::InvalidPosition;
using dch::Vec3;
using dch::necklace::Chains;
using dch::necklace::ChainTrees;
using dch::necklace::LayeredHierarchy;
using dch::necklace::Necklace;
using dch::necklace::necklace_of;
using dch::necklace::Shape;
using dch::necklace::Verification;
using dch::necklace::WrappedHierarchy;
using dch::necklace::WrappedParams;
using dch::test::fault;
using dch::test::message_of;
using testing::HasSubstr;

double lg(std::size_t n) { return std::ceil(std::log2(double(n))); }

std::vector<double> random_radii(std::size_t n, double ratio, std::uint64_t seed) {
  dch::scenes::Random random(seed);
  std::vector<double> radii(n);
  for (double& radius : radii) radius = 0.5 * std::pow(ratio, -random.uniform());
  return radii;
}

void shake(std::vector<Vec3>& positions, double by, std::uint64_t seed) {
  dch::scenes::Random random(seed);
  for (Vec3& p : positions) p = p + random.in_ball(by);
}

TEST(ChainTreesTest, HalveEachChain) {
  Chains chains(9);
  chains.add(std::vector<std::int32_t>{8, 7, 6});
  chains.add(std::vector<std::int32_t>{0, 1, 2, 3, 4}, true);
  const Necklace necklace(chains, 1);
  const ChainTrees trees(necklace, 1);
  ASSERT_EQ(trees.nodes().size(), 5U + 9U);
  ASSERT_EQ(trees.roots().size(), 2U);
  EXPECT_EQ(trees.roots()[1], 5);
  std::size_t leaves = 0;
  for (std::int32_t k = 0; k < 14; ++k) {
    const auto& node = trees.node(k);
    leaves += node.is_leaf() ? 1 : 0;
    if (node.is_leaf()) {
      EXPECT_EQ(node.count, 1);
      continue;
    }
    const auto &left = trees.node(ChainTrees::left(k)), &right = trees.node(node.right);
    EXPECT_EQ(left.first, node.first);
    EXPECT_EQ(right.first, left.first + left.count);
    EXPECT_EQ(left.count + right.count, node.count);
    EXPECT_LE(std::abs(left.count - right.count), 1);
  }
  EXPECT_EQ(leaves, 8U);
  EXPECT_EQ(ChainTrees(necklace, 4).nodes().size(), 4U);
}

TEST(ChainTreesTest, RefuseLeavesOutOfRange) {
  for (const int beads : {0, 65}) {
    EXPECT_THAT(message_of<InvalidParameter>([&] { ChainTrees(Necklace(), beads); }),
                HasSubstr("leaf_beads is " + std::to_string(beads)));
    EXPECT_THROW(WrappedHierarchy(Necklace(), {beads, Verification::cascade}), InvalidParameter);
    EXPECT_THROW(LayeredHierarchy(Necklace(), {beads}), InvalidParameter);
  }
}

TEST(Wrapped, CagesAreMinimumBallsOfTheirBeads) {
  for (const int leaf_beads : {1, 3, 8}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const Shape walk = dch::necklace::random_walk(static_cast<std::int32_t>(37 * seed), seed);
      WrappedHierarchy wrapped(
          Necklace::chain(random_radii(walk.positions.size(), 1 + 3.0 * double(seed), seed)),
          {leaf_beads, Verification::cascade});
      wrapped.build(walk.positions, Box::none());
      EXPECT_EQ(fault(wrapped), "") << "seed " << seed << ", leaves of " << leaf_beads;
      EXPECT_EQ(wrapped.stats().cages_checked, 0) << "the build does not count";
    }
  }
}

TEST(Wrapped, HardShapes) {
  const std::vector<Shape> shapes{dch::necklace::grid_necklace(64, 1, 1),
                                  dch::necklace::grid_necklace(16, 16, 1),
                                  dch::necklace::grid_necklace(6, 6, 6),
                                  dch::necklace::helix(200, 3.2, 0.3, 0.06),
                                  dch::necklace::torus_knot(2, 3, 100),
                                  dch::necklace::facing_bumps(40, 2, 0.4, 0.5),
                                  dch::necklace::tight_set(7),
                                  dch::necklace::globule(300, 0.1, 1),
                                  {std::vector<Vec3>(50, {1, 2, 3}), false},
                                  {{{0, 0, 0}, {1, 0, 0}, {1e12, 0, 0}, {2, 0, 0}}, false}};
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    for (const double radius : {0.0, 0.49}) {
      WrappedHierarchy wrapped(necklace_of(shapes[k], radius), {1, Verification::cascade});
      wrapped.build(shapes[k].positions, Box::none());
      EXPECT_EQ(fault(wrapped), "") << "shape " << k << ", radius " << radius;
      LayeredHierarchy layered(necklace_of(shapes[k], radius), {1});
      layered.update(shapes[k].positions, Box::none());
      EXPECT_EQ(dch::test::leaking_cage(layered), "") << "shape " << k << ", radius " << radius;
    }
  }
}

TEST(Wrapped, StaysRightUnderMotionOfAnySize) {
  for (const auto verification : {Verification::cascade, Verification::naive, Verification::watched}) {
    for (const double step : {1e-6, 0.01, 0.3, 20.0}) {
      Shape walk = dch::necklace::random_walk(300, 5);
      WrappedHierarchy wrapped(Necklace::chain(random_radii(300, 20, 6)), {1, verification});
      wrapped.build(walk.positions, Box::none());
      for (std::uint64_t k = 0; k < 8; ++k) {
        shake(walk.positions, step, k);
        wrapped.update(walk.positions, Box::none());
        ASSERT_EQ(fault(wrapped), "") << "step " << step << ", update " << k;
      }
      EXPECT_EQ(wrapped.stats().updates, 8);
      EXPECT_EQ(wrapped.stats().cages_checked, 8 * 299);
    }
  }
}

TEST(Wrapped, WithoutMotionNothingChanges) {
  const Shape walk = dch::necklace::random_walk(500, 9);
  WrappedHierarchy wrapped(necklace_of(walk, 0.4), {1, Verification::cascade});
  wrapped.build(walk.positions, Box::none());
  const std::vector<dch::necklace::Basis> before(wrapped.bases().begin(), wrapped.bases().end());
  wrapped.update(walk.positions, Box::none());
  EXPECT_EQ(wrapped.stats().basis_changes, 0);
  EXPECT_EQ(wrapped.stats().escapes, 0);
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_EQ(wrapped.bases()[k], before[k]);
}

TEST(Wrapped, RigidMotionLeavesTheBases) {
  const Shape walk = dch::necklace::random_walk(500, 10);
  WrappedHierarchy wrapped(necklace_of(walk, 0.4), {1, Verification::cascade});
  wrapped.build(walk.positions, Box::none());
  std::vector<Vec3> turned;
  for (const Vec3& p : walk.positions) turned.push_back({3 - p.y, 5 + p.x, 7 + p.z});
  wrapped.update(turned, Box::none());
  EXPECT_EQ(wrapped.stats().escapes, 0);
  EXPECT_EQ(wrapped.stats().basis_changes, 0);
}

TEST(Wrapped, AShrunkenBasisIsNoticed) {
  // Three beads of a triangle that becomes a line: one leaves the basis, none escapes.
  std::vector<Vec3> beads{{0, 0, 0}, {0.5, 0.8, 0}, {1, 0, 0}};
  WrappedHierarchy wrapped(Necklace::chain({0, 0, 0}), {1, Verification::cascade});
  wrapped.build(beads, Box::none());
  EXPECT_EQ(wrapped.bases()[0].size, 3);
  beads[1].y = 0.1;
  wrapped.update(beads, Box::none());
  EXPECT_EQ(wrapped.bases()[0].size, 2);
  EXPECT_EQ(wrapped.stats().basis_changes, 1);
  EXPECT_EQ(wrapped.stats().escapes, 0);
  EXPECT_DOUBLE_EQ(wrapped.cages()[0].radius, 0.5);
}

TEST(Wrapped, CascadeTestsLessThanTheNaiveWay) {
  Shape walk = dch::necklace::random_walk(4096, 11);
  WrappedHierarchy cascade(necklace_of(walk, 0.5), {1, Verification::cascade});
  WrappedHierarchy naive(necklace_of(walk, 0.5), {1, Verification::naive});
  cascade.build(walk.positions, Box::none());
  naive.build(walk.positions, Box::none());
  shake(walk.positions, 0.001, 1);
  cascade.update(walk.positions, Box::none());
  naive.update(walk.positions, Box::none());
  EXPECT_GE(naive.stats().containment_tests, 4096 * 12);
  EXPECT_LE(cascade.stats().containment_tests, 4 * 4096);
}

TEST(Wrapped, FollowsChainsThroughEveryBox) {
  for (const auto& scene : dch::scenes::all_boxes(6)) {
    const Box& box = scene.box;
    Shape walk = dch::necklace::random_walk(200, 12);
    Necklace necklace = necklace_of(walk, 0.3);
    WrappedHierarchy wrapped(necklace, {1, Verification::cascade});
    LayeredHierarchy layered(necklace, {1});
    for (std::uint64_t k = 0; k < 4; ++k) {
      shake(walk.positions, 0.05, k);
      std::vector<Vec3> wrapped_in;
      for (const Vec3& p : walk.positions) wrapped_in.push_back(box.wrap(p));
      wrapped.update(wrapped_in, box);
      layered.update(wrapped_in, box);
      ASSERT_EQ(fault(wrapped), "") << scene.name;
      ASSERT_EQ(dch::test::leaking_cage(layered), "") << scene.name;
      for (std::size_t b = 1; b < 200; ++b) {
        const Vec3 whole = wrapped.beads()[b].center - wrapped.beads()[0].center;
        EXPECT_LT(norm2(whole - (walk.positions[b] - walk.positions[0])), 1e-20) << scene.name;
      }
    }
  }
}

TEST(Wrapped, SmallestInputs) {
  for (const std::size_t n : {0U, 1U, 2U}) {
    WrappedHierarchy wrapped(Necklace::chain(std::vector<double>(n, 0.5)));
    LayeredHierarchy layered(Necklace::chain(std::vector<double>(n, 0.5)));
    const std::vector<Vec3> positions(n, {1, 1, 1});
    for (int k = 0; k < 2; ++k) {
      wrapped.update(positions, Box::none());
      layered.update(positions, Box::none());
    }
    EXPECT_EQ(wrapped.cages().size(), n == 0 ? 0U : 1U);
    for (const dch::necklace::Ball& cage : wrapped.cages()) EXPECT_EQ(cage.radius, 0.5);
    for (const dch::necklace::Ball& cage : layered.cages()) EXPECT_EQ(cage.radius, 0.5);
  }
}

TEST(Wrapped, HoldsNothingAfterAThrowAndRecovers) {
  const Shape walk = dch::necklace::random_walk(50, 1);
  WrappedHierarchy wrapped(necklace_of(walk, 0.5));
  wrapped.update(walk.positions, Box::none());
  auto bad = walk.positions;
  bad[7].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message_of<InvalidPosition>([&] { wrapped.update(bad, Box::none()); }), HasSubstr("bead 7"));
  EXPECT_TRUE(wrapped.beads().empty());
  EXPECT_TRUE(wrapped.cages().empty());
  EXPECT_THROW(wrapped.update(std::vector<Vec3>(3), Box::none()), InvalidParameter);
  EXPECT_THROW(wrapped.update(walk.positions, Box::orthorhombic({1.5, 9, 9})), dch::necklace::Undetermined);
  wrapped.update(walk.positions, Box::none());
  EXPECT_EQ(fault(wrapped), "");
  LayeredHierarchy layered(necklace_of(walk, 0.5));
  EXPECT_THROW(layered.update(bad, Box::none()), InvalidPosition);
}

TEST(Layered, RadiiStayWithinTheBounds) {
  for (int seed = 1; seed <= dch::effort(60); ++seed) {
    dch::scenes::Random random(static_cast<std::uint64_t>(seed));
    const std::size_t n = 2 + random.below(300);
    const bool equal = seed % 2 == 0;
    const Shape walk =
        dch::necklace::random_walk(static_cast<std::int32_t>(n), static_cast<std::uint64_t>(seed));
    const Necklace necklace =
        Necklace::chain(random_radii(n, equal ? 1 : 20, static_cast<std::uint64_t>(seed)));
    WrappedHierarchy wrapped(necklace, {1, Verification::cascade});
    LayeredHierarchy layered(necklace, {1});
    wrapped.build(walk.positions, Box::none());
    layered.update(walk.positions, Box::none());
    const double ratio = layered.cages()[0].radius / wrapped.cages()[0].radius;
    EXPECT_GE(ratio, 1 - 1e-12);
    EXPECT_LE(ratio, std::sqrt(lg(n) + (equal ? 0 : 1)) + 1e-12) << "seed " << seed;
  }
}

}  // namespace
