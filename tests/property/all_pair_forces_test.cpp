// SPDX-License-Identifier: MIT
//
// Forces of all pairs without a cutoff, by each instruction set, on one thread and several, equal those of a
// plain loop in long double.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/forces/all_pair_forces.hpp>

#include "error_message.hpp"
#include "instruction_sets.hpp"
#include "random.hpp"

namespace dch {
namespace {

constexpr double kConstant = 138.9;

struct Cloud {
  std::vector<Vec3> points;
  std::vector<LennardJonesParticle> particles;
  std::vector<double> charges;
  Exclusions exclusions;

  /// Molecules of up to four particles anywhere in a cube, the first particle of each excluded from the
  /// others and, in some, at the same place as the second; and pairs that are excluded far away from each
  /// other.
  Cloud(std::uint64_t seed, std::size_t count, Vec3 at = {0, 0, 0}) {
    scenes::Random random(seed);
    const double edge = 0.5 * std::cbrt(static_cast<double>(count));
    std::vector<IndexPair> excluded;
    std::int32_t head = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto index = static_cast<std::int32_t>(i);
      if (i == 0 || random.below(3) == 0) {
        head = index;
        points.push_back(at + random.vector<Vec3>(0, edge));
      } else {
        const Vec3 arm = random.vector<Vec3>(-0.2, 0.2);
        points.push_back(points[static_cast<std::size_t>(head)] + (index == head + 1 ? Vec3{0, 0, 0} : arm));
        excluded.push_back({head, index});
      }
      if (i > 200 && random.below(4) == 0)
        excluded.push_back({static_cast<std::int32_t>(random.below(i)), index});
      particles.push_back({random.below(3) == 0 ? 0 : random.uniform(0.1, 1), random.uniform(0.1, 0.2)});
      charges.push_back(random.uniform(-1, 1));
    }
    exclusions = Exclusions::from_pairs(count, excluded);
  }
  AllPairForces forces() const { return {particles, charges, kConstant, exclusions}; }
};

struct Found {
  explicit Found(std::size_t count) : forces(count) {}
  double energy = 0, size_of_energy = 0;
  std::vector<Vec3> forces;
};

Found expected_of(const Cloud& of) {
  Found sum(of.points.size());
  for (std::size_t i = 0; i < of.points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (of.exclusions.excluded(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j))) continue;
      const Vec3 d = of.points[j] - of.points[i];
      const long double r = std::sqrt(static_cast<long double>(norm2(d)));
      const long double s6 = std::pow((of.particles[i].sigma + of.particles[j].sigma) / 2 / r, 6);
      const long double epsilon =
          std::sqrt(static_cast<long double>(of.particles[i].epsilon) * of.particles[j].epsilon);
      const long double coulomb = kConstant * of.charges[i] * of.charges[j] / r;
      const auto over_r2 = static_cast<double>((24 * epsilon * (2 * s6 * s6 - s6) + coulomb) / (r * r));
      const auto energy = static_cast<double>(4 * epsilon * (s6 * s6 - s6) + coulomb);
      sum.energy += energy;
      sum.size_of_energy += std::abs(energy);
      sum.forces[i] = sum.forces[i] - over_r2 * d;
      sum.forces[j] = sum.forces[j] + over_r2 * d;
    }
  return sum;
}

Found found_of(const Cloud& of, Executor* executor) {
  Found sum(of.points.size());
  AllPairForces forces = of.forces();
  forces.set_executor(executor);
  sum.energy = forces.add_forces(of.points, sum.forces, true);
  Found again(of.points.size());
  EXPECT_EQ(forces.add_forces(of.points, again.forces, false), 0);
  EXPECT_EQ(again.forces, sum.forces);
  return sum;
}

/// The largest error of a force over the size of the one that is expected, or of the mean one.
double error_of(const Found& expected, const Found& found) {
  double mean = 0, worst = 0;
  for (const Vec3 f : expected.forces)
    mean += std::sqrt(norm2(f)) / static_cast<double>(expected.forces.size());
  for (std::size_t i = 0; i < expected.forces.size(); ++i)
    worst = std::max(worst, std::sqrt(norm2(found.forces[i] - expected.forces[i])) /
                                std::max(mean, std::sqrt(norm2(expected.forces[i]))));
  return worst;
}

TEST(AllPairForces, EqualThePlainSum) {
  const RestoreInstructionSet restore;
  for (const std::size_t count : {0, 1, 2, 3, 17, 127, 128, 129, 700})
    for (const double at : {0.0, 1e4}) {
      const Cloud cloud(count + 1, count, {at, -at, at});
      const Found expected = expected_of(cloud);
      for (const InstructionSet set : supported_sets()) {
        set_instruction_set(set);
        SCOPED_TRACE(testing::Message() << name(set) << ", " << count << " particles at " << at);
        const Found found = found_of(cloud, nullptr);
        EXPECT_LT(error_of(expected, found), 1e-5);
        EXPECT_NEAR(found.energy, expected.energy, 1e-6 * expected.size_of_energy);
      }
    }
}

TEST(AllPairForces, AreTheSameOnAnyNumberOfThreads) {
  const Cloud cloud(5, 1500);
  const Found expected = found_of(cloud, nullptr);
  for (const int threads : {2, 3, 20}) {
    const auto pool = make_thread_pool(threads);
    const Found found = found_of(cloud, pool.get());
    EXPECT_EQ(found.forces, expected.forces) << threads;
    EXPECT_EQ(found.energy, expected.energy) << threads;
  }
}

TEST(AllPairForces, ActWithoutChargesAndNotBeyondWhatHasASquare) {
  Cloud cloud(3, 40);
  cloud.charges.clear();
  AllPairForces forces = cloud.forces();
  cloud.points.back().x = 1e20;
  Found found(40);
  EXPECT_TRUE(std::isfinite(forces.add_forces(cloud.points, found.forces, true)));
  EXPECT_EQ(found.forces.back(), (Vec3{0, 0, 0}));
}

TEST(AllPairForces, RefuseBadInput) {
  const Cloud good(4, 10);
  const auto complaint = [](const Cloud& cloud, double constant) {
    return test::message_of<InvalidParameter>(
        [&] { AllPairForces(cloud.particles, cloud.charges, constant, cloud.exclusions); });
  };
  const auto expect_named = [&](const auto& spoil, const std::string& what) {
    Cloud bad = good;
    spoil(bad);
    EXPECT_NE(complaint(bad, 1).find(what), std::string::npos) << complaint(bad, 1);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_named([](Cloud& c) { c.charges.pop_back(); }, "9 charges given for 10 particles");
  expect_named([&](Cloud& c) { c.charges[3] = nan; }, "the charge of particle 3");
  expect_named([](Cloud& c) { c.particles[2].sigma = -0.5; }, "sigma of particle 2 is -0.5");
  expect_named([&](Cloud& c) { c.particles[2].epsilon = nan; }, "epsilon of particle 2");
  expect_named(
      [](Cloud& c) {
        c.exclusions = Exclusions::from_pairs(3, std::vector<IndexPair>{{0, 1}});
      },
      "3 rows of exclusions");
  EXPECT_NE(complaint(good, -1).find("constant of all pairs is -1"), std::string::npos);
  std::vector<Vec3> forces(10);
  EXPECT_NE(test::message_of<InvalidParameter>([&] {
              good.forces().add_forces(Span<const Vec3>(good.points.data(), 9), forces, true);
            }).find("9 positions"),
            std::string::npos);
}

}  // namespace
}  // namespace dch
