// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <dch/necklace/closest_pair.hpp>
#include <dch/necklace/shapes.hpp>
#include <dch/necklace/walks.hpp>
#include <dch/power_diagram/power_diagram.hpp>

#include "closest_oracle.hpp"
#include "effort.hpp"
#include "error_message.hpp"
#include "random.hpp"

namespace {

using dch::Box;
using dch::InvalidParameter;
using dch::InvalidPosition;
using dch::Vec3;
using dch::necklace::Chains;
using dch::necklace::ClosestPair;
using dch::necklace::ClosestPairStats;
using dch::necklace::Contact;
using dch::necklace::Necklace;
using dch::necklace::PowerDiagram;
using dch::necklace::Shape;
using dch::scenes::Random;
using dch::test::closest_oracle;
using dch::test::message_of;
using testing::HasSubstr;

ClosestPair finder_of(const Necklace& necklace) {
  return ClosestPair(necklace, std::make_unique<PowerDiagram>());
}

/// The finder names the pair that all pairs give, for every number of bonds to skip.
void expect_right(ClosestPair& finder, const std::vector<Vec3>& positions, const std::string& where) {
  finder.update(positions, Box::none());
  for (const int skip_bonds : {0, 1, 2, 5}) {
    const auto expected = closest_oracle(finder.necklace(), positions, skip_bonds);
    const std::optional<Contact> found = finder.find(skip_bonds);
    ASSERT_EQ(found.has_value(), expected.i >= 0) << where << ", skip " << skip_bonds;
    if (!found) continue;
    EXPECT_EQ(found->gap, expected.gap) << where << ", skip " << skip_bonds;
    EXPECT_EQ(found->i, expected.i) << where << ", skip " << skip_bonds;
    EXPECT_EQ(found->j, expected.j) << where << ", skip " << skip_bonds;
  }
}

void expect_right(const Shape& shape, double radius, const std::string& where) {
  ClosestPair finder = finder_of(necklace_of(shape, radius));
  expect_right(finder, shape.positions, where);
}

/// Chains of random numbers of beads, some closed, bead numbers out of order; solvent in between.
struct Scene {
  Necklace necklace;
  std::vector<Vec3> positions;
};

Scene random_scene(std::uint64_t seed, bool equal) {
  Random random(seed);
  const std::size_t total = 2 + random.below(seed % 5 == 0 ? 150 : 40), particles = total + random.below(4);
  std::vector<std::int32_t> names(particles);
  for (std::size_t k = 0; k < particles; ++k) names[k] = static_cast<std::int32_t>(k);
  random.shuffle(names);
  Scene scene;
  Chains chains(particles);
  scene.positions.assign(particles, Vec3{});
  const double spread = random.uniform(0, 6), bond = random.uniform(0.1, 1.5);
  for (std::size_t begin = 0; begin < total;) {
    const std::size_t beads = random.uniform() < 0.5 ? total - begin : 1 + random.below(total - begin);
    Vec3 at = random.in_cube(spread);
    for (std::size_t k = 0; k < beads; ++k, at = at + random.in_ball(bond)) {
      scene.positions[static_cast<std::size_t>(names[begin + k])] = at;
    }
    chains.add({names.data() + begin, beads}, beads >= 3 && random.uniform() < 0.4);
    begin += beads;
  }
  std::vector<double> radii(particles, random.uniform(0, 0.6));
  for (double& radius : radii) radius = equal ? radius : 0.8 * std::pow(20, -random.uniform());
  scene.necklace = Necklace(chains, radii);
  return scene;
}

TEST(ClosestPair, EqualsBruteForceForEqualRadii) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(dch::effort(400)); ++seed) {
    const Scene scene = random_scene(seed, true);
    ClosestPair finder = finder_of(scene.necklace);
    expect_right(finder, scene.positions, "seed " + std::to_string(seed));
    if (HasFailure()) return;
  }
}

/// With small balls inside large ones, with bonded balls apart, with others that overlap.
TEST(ClosestPair, EqualsBruteForceForRadiiOfAnyRatio) {
  for (std::uint64_t seed = 1001; seed <= 1000 + static_cast<std::uint64_t>(dch::effort(400)); ++seed) {
    const Scene scene = random_scene(seed, false);
    ClosestPair finder = finder_of(scene.necklace);
    expect_right(finder, scene.positions, "seed " + std::to_string(seed));
    if (HasFailure()) return;
  }
}

TEST(ClosestPair, EqualsBruteForceUnderMotion) {
  for (std::uint64_t seed = 2001; seed <= 2000 + static_cast<std::uint64_t>(dch::effort(40)); ++seed) {
    Scene scene = random_scene(seed, seed % 2 == 0);
    ClosestPair finder = finder_of(scene.necklace);
    Random random(seed);
    const double step = std::pow(10, random.uniform(-4, 0));
    for (int k = 0; k < 10; ++k) {
      expect_right(finder, scene.positions, "seed " + std::to_string(seed) + ", step " + std::to_string(k));
      if (HasFailure()) return;
      for (Vec3& p : scene.positions) p = p + random.in_ball(step);
    }
  }
}

TEST(ClosestPair, DegeneratePlaces) {
  expect_right(dch::necklace::grid_necklace(5, 4, 3), 0.5, "grid in space");
  expect_right(dch::necklace::grid_necklace(6, 6, 1), 0.4, "grid in the plane");
  expect_right(dch::necklace::grid_necklace(20, 1, 1), 0.49, "line");
  expect_right(dch::necklace::tight_set(6), 0.01, "circle");
  expect_right({std::vector<Vec3>(40, {1, 2, 3}), false}, 0.5, "one place");
  expect_right({std::vector<Vec3>(40, {1, 2, 3}), true}, 0.5, "one place, closed");
  // Beads two by two at one place, so that neighbors alone stand together.
  Shape doubled = dch::necklace::grid_necklace(3, 3, 3);
  std::vector<Vec3> twice;
  for (const Vec3& p : doubled.positions) twice.insert(twice.end(), 2, p);
  expect_right({twice, false}, 0.3, "two at each place");
  expect_right({{{0, 0, 0}, {1, 0, 0}, {1e12, 0, 0}, {2, 0, 0}, {1.5, 0, 0}}, false}, 0.5, "one far away");
}

TEST(ClosestPair, FewBeads) {
  expect_right({{}, false}, 0.5, "none");
  expect_right({{{1, 2, 3}}, false}, 0.5, "one");
  expect_right({{{1, 2, 3}, {2, 2, 3}}, false}, 0.5, "two");
  expect_right({{{1, 2, 3}, {2, 2, 3}, {2.5, 3, 3}}, true}, 0.5, "triangle");
}

/// Bead 1 lies between the closest pair, 0 and 2, which share no edge but a neighbor.
TEST(ClosestPair, FindsPairsWithACommonNeighbor) {
  const Shape shape{{{0, 0, 0}, {0.5, 0.01, 0}, {1, 0, 0}, {0.5, 9, 0}, {0.5, -9, 1}, {0, 0, 9}, {0, 0, -9}},
                    false};
  PowerDiagram diagram;
  std::vector<dch::necklace::Ball> balls;
  for (const Vec3& p : shape.positions) balls.push_back({p, 0.2});
  diagram.update(balls);
  ASSERT_THAT(diagram.edges(), testing::Not(testing::Contains(dch::IndexPair{0, 2})));
  ClosestPair finder = finder_of(necklace_of(shape, 0.2));
  finder.update(shape.positions, Box::none());
  ClosestPairStats stats;
  const auto found = finder.find(1, &stats);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->i, 0);
  EXPECT_EQ(found->j, 2);
  EXPECT_DOUBLE_EQ(found->gap, 0.6);
  EXPECT_EQ(found->on_i, (Vec3{0.2, 0, 0}));
  EXPECT_EQ(stats.common, 5);
  EXPECT_EQ(stats.edges, static_cast<std::int64_t>(diagram.edges().size()));
  EXPECT_EQ(stats.listed, 0);
}

TEST(ClosestPair, RefusesWhatItCannotAnswer) {
  const Necklace necklace = Necklace::chain({0.5, 0.5, 0.5});
  EXPECT_THAT(message_of<InvalidParameter>([&] { ClosestPair(necklace, nullptr); }), HasSubstr("no diagram"));
  ClosestPair finder = finder_of(necklace);
  EXPECT_THAT(message_of<InvalidParameter>([&] { finder.find(); }), HasSubstr("no positions"));
  const std::vector<Vec3> three{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_THAT(message_of<InvalidParameter>([&] {
                finder.update(three, Box::orthorhombic({9, 9, 9}));
              }),
              HasSubstr("periodic"));
  EXPECT_THROW(finder.update(std::vector<Vec3>{{0, 0, 0}}, Box::none()), InvalidParameter);
  EXPECT_THROW(finder.update(std::vector<Vec3>{{0, 0, 0}, {NAN, 0, 0}, {1, 0, 0}}, Box::none()),
               InvalidPosition);
  EXPECT_THROW(finder.find(), InvalidParameter);
  finder.update(three, Box::none());
  EXPECT_THAT(message_of<InvalidParameter>([&] { finder.find(-1); }), HasSubstr("-1"));
  EXPECT_TRUE(finder.find().has_value());
}

}  // namespace
