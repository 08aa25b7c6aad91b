// SPDX-License-Identifier: MIT
//
// Event-driven hard spheres against all pairs, in every box, with sizes 1:20, growth and lossy collisions;
// what the laws of mechanics keep; and pressures against equations of state.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <dch/kinetic/sphere_growth.hpp>

#include "effort.hpp"
#include "hard_sphere_oracle.hpp"
#include "scenes.hpp"

namespace dch::kinetic {
namespace {

/// Spheres at random places, as large as they can be without overlap.
struct RandomSpheres {
  RandomSpheres(std::uint64_t seed, std::size_t count) : random(seed) {
    const auto boxes = scenes::all_boxes(random.uniform(3, 7));
    const scenes::NamedBox& box = boxes[random.below(boxes.size())];
    params.box = box.box;
    const double ratio = random.below(2) == 0 ? 1 : 20;
    for (const Vec3 p : scenes::uniform(count, {5, 5, 5}, seed)) {
      positions.push_back(params.box.wrap(p));
      velocities.push_back(random.in_cube(1));
      params.radii.push_back(std::pow(ratio, -random.uniform()));
      params.masses.push_back(std::pow(params.radii.back(), 3));
    }
    double scale = std::min(1.0, 0.2 * params.box.max_cutoff());
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a + 1; b < count; ++b)
        scale = std::min(scale, std::sqrt(params.box.distance2(positions[a], positions[b])) /
                                    (params.radii[a] + params.radii[b]));
    for (double& radius : params.radii) radius *= 0.999 * scale;
    params.restitution = random.below(3) == 0 ? 0.7 : 1;
    growth = random.below(2) == 0 ? random.uniform(0.1, 3) : 0;
    what = "seed " + std::to_string(seed) + ": " + std::to_string(count) + " spheres in " + box.name +
           ", sizes 1:" + std::to_string(ratio) + ", restitution " + std::to_string(params.restitution) +
           ", growth " + std::to_string(growth);
  }

  scenes::Random random;
  HardSphereParams params;
  std::vector<Vec3> positions, velocities;
  double growth = 0;
  std::string what;
};

/// Returns how many collisions there were.
int check(const RandomSpheres& scene, int collisions, double limit) {
  SCOPED_TRACE(scene.what);
  HardSpheres spheres(scene.params, scene.positions, scene.velocities);
  spheres.set_growth(scene.growth);
  std::vector<double> growth;
  for (const double radius : scene.params.radii) growth.push_back(scene.growth * radius);
  HardSphereOracle oracle(spheres, scene.params.restitution, growth);
  for (int k = 0; k < collisions; ++k) {
    const auto expected = oracle.next(limit);
    const auto found = spheres.step(limit);
    EXPECT_EQ(found.has_value(), expected.pair.a >= 0) << "collision " << k;
    if (!found || testing::Test::HasFailure()) return k;
    EXPECT_NEAR(found->time - oracle.now(), static_cast<double>(expected.after), 1e-9) << "collision " << k;
    oracle.check(*found);
    EXPECT_GT(oracle.least_gap(), -1e-12);
    EXPECT_GE(spheres.least_gap(), oracle.least_gap());
  }
  return collisions;
}

TEST(HardSpheres, CollideAsAllPairsDo) {
  std::int64_t collisions = 0;
  for (int k = 0; k < effort(120) && !testing::Test::HasFailure(); ++k) {
    RandomSpheres scene(5000000 + static_cast<std::uint64_t>(k), 1 + static_cast<std::size_t>(k % 24));
    // Grown spheres must fit into the smallest boxes.
    const double limit = scene.growth > 0 ? 1 / scene.growth : 50;
    collisions += check(scene, 60, limit);
  }
  EXPECT_GT(collisions, effort(120) * 5);
}

/// The same where spheres have neighbors on all sides, and in boxes of which they take a large part.
TEST(HardSpheres, CollideAsAllPairsDoWhereTheyAreDense) {
  for (int k = 0; k < effort(24) && !testing::Test::HasFailure(); ++k) {
    RandomSpheres scene(5100000 + static_cast<std::uint64_t>(k), 40);
    SCOPED_TRACE(scene.what);
    if (scene.params.box.rank() < 3) continue;
    scene.params.restitution = 1;
    HardSpheres spheres(scene.params, scene.positions, scene.velocities);
    const double largest = *std::max_element(scene.params.radii.begin(), scene.params.radii.end());
    const double widest = 0.4 * scene.params.box.max_cutoff() / largest;
    const double volume = scene.params.box.volume() / spheres.volume();
    grow(spheres, {3, std::min(0.3, std::pow(widest, 3) / volume), 1e6});
    HardSphereOracle oracle(spheres, 1, std::vector<double>(40, 0.0));
    for (int collision = 0; collision < 120 && !testing::Test::HasFailure(); ++collision) {
      const auto expected = oracle.next(1e6);
      const auto found = spheres.step(1e6);
      ASSERT_TRUE(found && expected.pair.a >= 0);
      EXPECT_NEAR(found->time - oracle.now(), static_cast<double>(expected.after), 1e-9);
      oracle.check(*found);
      EXPECT_GT(oracle.least_gap(), -1e-12);
    }
  }
}

/// Equal spheres on a cubic lattice, with random velocities whose sum is zero.
struct LatticeSpheres {
  LatticeSpheres(int side, double fraction, std::uint64_t seed = 1) {
    const double spacing = std::cbrt(std::numbers::pi / 6 / fraction);
    params.box = Box::orthorhombic({side * spacing, side * spacing, side * spacing});
    scenes::Random random(seed);
    Vec3 sum;
    for (int k = 0; k < side * side * side; ++k) {
      positions.push_back(spacing * Vec3{1.0 * (k % side), 1.0 * (k / side % side), 1.0 * (k / side / side)});
      velocities.push_back(random.in_ball(1));
      sum = sum + velocities.back();
    }
    for (Vec3& v : velocities) v = v - (1.0 / static_cast<double>(velocities.size())) * sum;
    params.radii.assign(positions.size(), 0.5);
  }
  HardSpheres make() const { return {params, positions, velocities}; }

  HardSphereParams params;
  std::vector<Vec3> positions, velocities;
};

void collide(HardSpheres& spheres, std::int64_t times) {
  for (std::int64_t k = 0; k < times; ++k) ASSERT_TRUE(spheres.step(1e9));
}

/// Over that of an ideal gas, in the next so many collisions of each sphere.
double measure_pressure(HardSpheres& spheres, std::int64_t collisions) {
  const double from = spheres.now(), virial = spheres.virial();
  collide(spheres, collisions * static_cast<std::int64_t>(spheres.size()));
  return 1 + (spheres.virial() - virial) / (2 * spheres.energy() * (spheres.now() - from));
}

TEST(HardSpheres, KeepEnergyAndMomentumAndDoNotOverlap) {
  HardSpheres spheres = LatticeSpheres(8, 0.45).make();
  const double energy = spheres.energy();
  for (int k = 0; k < 20; ++k) {
    collide(spheres, effort(10000));
    EXPECT_GT(spheres.least_gap(), -1e-13);
  }
  EXPECT_NEAR(spheres.energy() / energy, 1, 1e-12);
  EXPECT_LT(std::sqrt(norm2(spheres.momentum())), 1e-11 * std::sqrt(energy));
}

TEST(HardSpheres, HaveThePressureOfCarnahanAndStarling) {
  for (const double y : {0.2, 0.45}) {
    HardSpheres spheres = LatticeSpheres(10, y).make();
    collide(spheres, 40 * 1000);
    const double expected = (1 + y + y * y - y * y * y) / std::pow(1 - y, 3);
    EXPECT_NEAR(measure_pressure(spheres, 100) / expected, 1, 0.01) << y;
  }
}

/// What is to come depends on the spheres alone: not on when somebody looked, nor on what was before.
TEST(HardSpheres, GoOnToTheLastBitFromWhereTheyWere) {
  const LatticeSpheres scene(6, 0.4);
  HardSpheres once = scene.make(), looked_at = scene.make();
  collide(once, 2000);
  for (double time = 0; looked_at.counters().collisions < 2000;) {
    if (const auto collision = looked_at.step(time += 1e-4); collision) time = collision->time;
  }
  once.synchronize();
  looked_at.synchronize();
  HardSphereParams params = scene.params;
  std::vector<Vec3> positions, velocities;
  for (std::int32_t id = 0; id < 216; ++id) {
    EXPECT_EQ(once.position(id), looked_at.position(id));
    positions.push_back(once.position(id));
    velocities.push_back(once.velocity(id));
  }
  HardSpheres again(params, positions, velocities, once.now());
  for (int k = 0; k < 20000; ++k) {
    const auto expected = once.step(1e9), found = again.step(1e9);
    ASSERT_EQ(found->time, expected->time);
    ASSERT_EQ(found->pair, expected->pair);
    ASSERT_EQ(found->impulse, expected->impulse);
  }
}

/// Predictions a collision, once the balls of spheres have the radii that they come to have.
double count_predictions(HardSpheres& spheres) {
  collide(spheres, 20 * static_cast<std::int64_t>(spheres.size()));
  const HardSphereCounters before = spheres.counters();
  collide(spheres, 10 * static_cast<std::int64_t>(spheres.size()));
  const HardSphereCounters& after = spheres.counters();
  const auto collisions = static_cast<double>(after.collisions - before.collisions);
  EXPECT_LT(static_cast<double>(after.homes - before.homes) / collisions, 0.8);
  EXPECT_LT(static_cast<double>(after.anchors - before.anchors) / collisions, 0.3);
  return static_cast<double>(after.predictions - before.predictions) / collisions;
}

/// The work of a collision does not grow with the number of spheres.
TEST(HardSpheres, CostOfACollisionAsCounted) {
  HardSpheres few = LatticeSpheres(8, 0.45).make(), many = LatticeSpheres(16, 0.45).make();
  const double of_few = count_predictions(few), of_many = count_predictions(many);
  EXPECT_LT(of_few, 45);
  EXPECT_NEAR(of_many / of_few, 1, 0.1);
}

/// Sizes 1:10, as many of each, on the places of a lattice; they grow to where they are to be.
HardSpheres make_mixture(int side, double ratio, double fraction) {
  LatticeSpheres scene(side, std::numbers::pi / 6 * 0.999);
  scenes::Random random(5);
  random.shuffle(scene.positions);
  for (std::size_t k = 0; k < scene.positions.size(); ++k) {
    const double radius = k % 2 == 0 ? 0.49 : 0.49 / ratio;
    scene.params.radii[k] = radius;
    scene.params.masses.push_back(std::pow(2 * radius, 3));
    scene.velocities[k] = (1 / std::sqrt(scene.params.masses[k])) * scene.velocities[k];
  }
  HardSpheres spheres = scene.make();
  GrowthParams growth;
  growth.rate = 1;
  growth.fraction = fraction;
  const GrowthResult grown = grow(spheres, growth);
  EXPECT_FALSE(grown.is_jammed);
  EXPECT_NEAR(grown.fraction, fraction, 1e-9);
  // Walls that grow give more energy to the slow spheres.
  for (std::size_t k = 0; k < scene.positions.size(); ++k) {
    scene.positions[k] = spheres.position(static_cast<std::int32_t>(k));
    scene.params.radii[k] = spheres.radius(static_cast<std::int32_t>(k));
  }
  return scene.make();
}

/// G. A. Mansoori, N. F. Carnahan, K. E. Starling and T. W. Leland, J. Chem. Phys. 54:1523, 1971.
double mixture_pressure(const HardSpheres& spheres) {
  double m[4] = {};
  for (std::int32_t id = 0; id < static_cast<std::int32_t>(spheres.size()); ++id)
    for (int k = 0; k < 4; ++k)
      m[k] += std::pow(2 * spheres.radius(id), k) / static_cast<double>(spheres.size());
  const double y = spheres.volume() / spheres.box().volume(), c = y / m[3];
  return 1 / (1 - y) + 3 * c * m[1] * m[2] / std::pow(1 - y, 2) +
         (3 - y) * c * c * std::pow(m[2], 3) / std::pow(1 - y, 3);
}

TEST(HardSpheres, MixturesHaveThePressureOfBoublikMansooriCarnahanStarlingAndLeland) {
  for (const double ratio : {3.0, 10.0}) {
    HardSpheres spheres = make_mixture(8, ratio, 0.4);
    collide(spheres, 60 * 512);
    EXPECT_NEAR(measure_pressure(spheres, 160) / mixture_pressure(spheres), 1, 0.015) << ratio;
  }
}

TEST(HardSpheres, CostOfACollisionOfUnlikeSizesAsCounted) {
  for (const double ratio : {10.0, 20.0}) {
    HardSpheres spheres = make_mixture(9, ratio, 0.45);
    EXPECT_LT(count_predictions(spheres), 100) << ratio;
  }
}

TEST(HardSpheres, JamAndStayApart) {
  LatticeSpheres scene(5, 0.2);
  HardSpheres spheres = scene.make();
  GrowthParams growth;
  growth.rate = 0.5;
  growth.most_pressure = 1e5;
  const GrowthResult jammed = grow(spheres, growth);
  EXPECT_TRUE(jammed.is_jammed);
  EXPECT_GT(jammed.pressure, 1e5);
  EXPECT_GT(jammed.fraction, 0.58);
  EXPECT_LT(jammed.fraction, std::numbers::pi / std::sqrt(18));
  EXPECT_GT(spheres.least_gap(), -1e-13);
}

}  // namespace
}  // namespace dch::kinetic
