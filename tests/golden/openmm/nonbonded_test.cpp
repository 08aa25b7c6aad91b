// SPDX-License-Identifier: MIT
//
// Small systems with forces known from formulas, and larger ones against OpenMM's own force. The cases are
// those of OpenMM's TestNonbondedForce.
//
// More than 300 lines: the cases of OpenMM's own test, in its order.
#include "all_pairs_oracle.hpp"

namespace OpenMMDCH {
namespace {

class NonbondedTest : public OnPlatform {};
DCH_IN_EACH_WAY(NonbondedTest);

/// The same force as OpenMM computes it, on its Reference platform.
OpenMM::System native_copy(const Case& of) {
  OpenMM::System system;
  for (int i = 0; i < of.system.getNumParticles(); ++i) system.addParticle(of.system.getParticleMass(i));
  Vec3 a, b, c;
  of.system.getDefaultPeriodicBoxVectors(a, b, c);
  system.setDefaultPeriodicBoxVectors(a, b, c);
  system.addForce(new OpenMM::NonbondedForce(of.force->getParameters()));
  return system;
}

Evaluation native(const Case& of) { return Host(native_copy(of), "Reference").evaluate(of.positions); }

/// Molecules of two charged atoms 0.1 apart at random places in a cube, of three kinds.
void add_dumbbells(Case& to, int molecules, double side, std::uint64_t seed) {
  dch::scenes::Random random(seed);
  for (int m = 0; m < molecules; ++m) {
    const double q = m % 3 == 0 ? 0.4 : 0.2, sigma = m % 2 == 0 ? 0.2 : 0.1, epsilon = m % 3 == 0 ? 0.1 : 0.3;
    const auto at = random.vector<Vec3>(0, side);
    to.add(-q, sigma, epsilon, at);
    to.add(q, sigma, epsilon, at + Vec3(0.1, 0, 0));
    to.force->addException(2 * m, 2 * m + 1, 0, 1, 0);
  }
}

TEST_P(NonbondedTest, Coulomb) {
  Case pair;
  pair.add(0.5, 1, 0, Vec3(0, 0, 0));
  pair.add(-1.5, 1, 0, Vec3(2, 0, 0));
  const Evaluation found = evaluate(pair, GetParam());
  const double force = kCoulomb * -0.75 / 4;
  expect_near({kCoulomb * -0.75 / 2, {Vec3(-force, 0, 0), Vec3(force, 0, 0)}}, found, tolerance());
}

TEST_P(NonbondedTest, LennardJones) {
  Case pair;
  pair.add(0, 1.2, 1, Vec3(0, 0, 0));
  pair.add(0, 1.4, 2, Vec3(2, 0, 0));
  const RadialTerms expected = lennard_jones(1.3, std::sqrt(2.0), 2);
  expect_near({expected.energy, {Vec3(-expected.force, 0, 0), Vec3(expected.force, 0, 0)}},
              evaluate(pair, GetParam()), tolerance());
}

TEST_P(NonbondedTest, OneParticle) {
  for (const auto method : {DCHNonbondedForce::NoCutoff, DCHNonbondedForce::CutoffNonPeriodic,
                            DCHNonbondedForce::CutoffPeriodic}) {
    Case one;
    one.add(1, 0.3, 1, Vec3(0, 0, 0));
    one.set_method(method, 0.9);
    one.force->setUseDispersionCorrection(false);
    expect_near({0, {Vec3()}}, evaluate(one, GetParam()), 0);
  }
}

TEST_P(NonbondedTest, ExclusionsAnd14) {
  Case chain;
  for (int i = 0; i < 5; ++i) chain.add(i == 0 || i == 3 ? 2.0 : 0.0, 1.5, i == 0 ? 1.5 : 0.0, Vec3());
  chain.force->createExceptionsFromBonds({{0, 1}, {1, 2}, {2, 3}, {3, 4}}, 0.5, 0.4);
  ASSERT_EQ(chain.force->getNumExceptions(), 4 + 3 + 2);
  for (int other = 1; other < 5; ++other) {
    for (int i = 0; i < 5; ++i) {
      const bool acts = i == 0 || i == other;
      chain.force->setParticleParameters(i, acts ? 2.0 : 0.0, 1.5, acts ? 1.5 : 0.0);
      // Others lie where they cannot matter.
      chain.positions[static_cast<std::size_t>(i)] = Vec3(i == other ? 2.0 : 0.0, acts ? 0 : 10.0 + i, 0);
    }
    for (int k = 0; k < chain.force->getNumExceptions(); ++k) {
      int i, j;
      double qq, sigma, epsilon;
      chain.force->getExceptionParameters(k, i, j, qq, sigma, epsilon);
      const bool is_14 = std::abs(i - j) == 3 && std::min(i, j) == 0 && std::max(i, j) == other;
      chain.force->setExceptionParameters(k, i, j, is_14 ? 2.0 : 0.0, 1.5, is_14 ? 0.6 : 0.0);
    }
    RadialTerms expected;
    if (other >= 3) {
      const double scale = other == 3 ? 0.4 : 1.0, charge_scale = other == 3 ? 0.5 : 1.0;
      expected = lennard_jones(1.5, scale * 1.5, 2);
      expected.energy += kCoulomb * charge_scale * 4 / 2;
      expected.force += kCoulomb * charge_scale * 4 / 4;
    }
    const Evaluation found = evaluate(chain, GetParam());
    const std::string what = "0 and " + std::to_string(other);
    expect_near(expected.energy, found.energy, tolerance(), what);
    expect_near(Vec3(-expected.force, 0, 0), found.forces[0], tolerance(), what);
    expect_near(Vec3(expected.force, 0, 0), found.forces[static_cast<std::size_t>(other)], tolerance(), what);
  }
}

TEST_P(NonbondedTest, Cutoff) {
  Case three;
  three.add(1, 1, 0, Vec3(0, 0, 0));
  three.add(1, 1, 0, Vec3(0, 2, 0));
  three.add(1, 1, 0, Vec3(0, 3, 0));
  three.set_method(DCHNonbondedForce::CutoffNonPeriodic, 2.9);
  three.force->setReactionFieldDielectric(50);
  const double k = std::pow(2.9, -3) * 49 / 101, c = 150.0 / 101 / 2.9;
  const double far = kCoulomb * (1.0 / 4 - 2 * k * 2), near = kCoulomb * (1 - 2 * k);
  const double energy = kCoulomb * (0.5 + 4 * k - c) + kCoulomb * (1 + k - c);
  expect_near({energy, {Vec3(0, -far, 0), Vec3(0, far - near, 0), Vec3(0, near, 0)}},
              evaluate(three, GetParam()), tolerance());
}

// Exceptions know neither cutoff nor reaction field.
TEST_P(NonbondedTest, Cutoff14) {
  Case chain;
  for (int i = 0; i < 5; ++i) chain.add(0.7, 0.4, 0.5, Vec3(i, 0, 0));
  chain.set_method(DCHNonbondedForce::CutoffNonPeriodic, 2.5);
  chain.force->setReactionFieldDielectric(30);
  chain.force->createExceptionsFromBonds({{0, 1}, {1, 2}, {2, 3}, {3, 4}}, 0.5, 0.4);
  const Evaluation found = evaluate(chain, GetParam());
  const RadialTerms lj = lennard_jones(0.4, 0.2, 3);
  const double qq = kCoulomb * 0.5 * 0.49;
  expect_near(2 * (lj.energy + qq / 3), found.energy, tolerance(), "energy");
  expect_near(Vec3(-lj.force - qq / 9, 0, 0), found.forces[0], tolerance(), "first");
  expect_near(Vec3(0, 0, 0), found.forces[2], tolerance(), "middle");
}

TEST_P(NonbondedTest, Periodic) {
  Case three;
  three.add(1, 1, 0, Vec3(0, 0, 0));
  three.add(1, 1, 0, Vec3(2, 0, 0));
  three.add(1, 1, 0, Vec3(3, 0, 0));
  three.force->addException(0, 1, 0, 1, 0);
  three.set_box(Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(0, 0, 4));
  three.set_method(DCHNonbondedForce::CutoffPeriodic, 2);
  const double k = std::pow(2.0, -3) * 77.3 / 157.6, c = 3 * 78.3 / 157.6 / 2;
  const double force = kCoulomb * (1 - 2 * k);
  expect_near({2 * kCoulomb * (1 + k - c), {Vec3(force, 0, 0), Vec3(-force, 0, 0), Vec3(0, 0, 0)}},
              evaluate(three, GetParam()), tolerance());
}

TEST_P(NonbondedTest, PeriodicExceptions) {
  Case pair;
  pair.add(1, 1, 0, Vec3(0, 0, 0));
  pair.add(1, 1, 0, Vec3(3, 0, 0));
  pair.force->addException(0, 1, 1, 1, 0);
  pair.set_box(Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(0, 0, 4));
  pair.set_method(DCHNonbondedForce::CutoffPeriodic, 2);
  const double force = kCoulomb / 9;
  expect_near({kCoulomb / 3, {Vec3(-force, 0, 0), Vec3(force, 0, 0)}}, evaluate(pair, GetParam()),
              tolerance());
  pair.force->setExceptionsUsePeriodicBoundaryConditions(true);
  expect_near({kCoulomb, {Vec3(kCoulomb, 0, 0), Vec3(-kCoulomb, 0, 0)}}, evaluate(pair, GetParam()),
              tolerance());
}

TEST_P(NonbondedTest, Triclinic) {
  Case pair;
  const Vec3 box[3] = {Vec3(3.1, 0, 0), Vec3(0.4, 3.5, 0), Vec3(-0.1, -0.5, 4.0)};
  pair.set_box(box[0], box[1], box[2]);
  pair.add(1, 1, 0, Vec3());
  pair.add(-1, 1, 0, Vec3());
  pair.set_method(DCHNonbondedForce::CutoffPeriodic, 1.5);
  Host host(pair.system, GetParam());
  dch::scenes::Random random(7);
  const auto anywhere = [&] {
    return box[0] * random.uniform(-2, 3) + box[1] * random.uniform(-2, 3) + box[2] * random.uniform(-2, 3);
  };
  int acting = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const std::vector<Vec3> positions{anywhere(), anywhere()};
    const Evaluation expected = all_pairs(*pair.force, positions, box);
    acting += expected.energy != 0;
    expect_near(expected, host.evaluate(positions), 1e-4, "trial " + std::to_string(trial));
  }
  EXPECT_GT(acting, 10);
}

TEST_P(NonbondedTest, LargeSystem) {
  Case many;
  const double side = 20;
  add_dumbbells(many, 600, side, 1);
  many.set_box(Vec3(side, 0, 0), Vec3(0, side, 0), Vec3(0, 0, side));
  for (const auto method : {DCHNonbondedForce::NoCutoff, DCHNonbondedForce::CutoffNonPeriodic,
                            DCHNonbondedForce::CutoffPeriodic}) {
    many.set_method(method, 2);
    const std::string what = "method " + std::to_string(method);
    expect_near(native(many), evaluate(many, GetParam()), tolerance(), what);
  }
}

TEST_P(NonbondedTest, HugeSystem) {
  Case grid;
  const int side = 27;
  const double spacing = 0.7;
  for (int k = 0; k < side * side * side; ++k)
    grid.add(0, 0.5, 1.0, spacing * Vec3(k % side, k / side % side, k / side / side));
  const double edge = spacing * side;
  grid.set_box(Vec3(edge, 0, 0), Vec3(0, edge, 0), Vec3(0, 0, edge));
  grid.set_method(DCHNonbondedForce::CutoffPeriodic, 1.7);
  grid.force->setUseDispersionCorrection(false);
  // Every particle sees the same.
  double energy = 0;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z)
        if (const double r = spacing * std::sqrt(x * x + y * y + z * z); r > 0 && r < 1.7)
          energy += lennard_jones(0.5, 1, r).energy / 2;
  const Evaluation found = evaluate(grid, GetParam());
  expect_near(energy * side * side * side, found.energy, tolerance(), "energy");
  for (const Vec3& force : found.forces) ASSERT_LT(force.dot(force), std::pow(100 * tolerance(), 2));
}

TEST_P(NonbondedTest, DispersionCorrection) {
  Case gas;
  const double cutoff = 2.1, side = 6;
  for (int k = 0; k < 216; ++k) gas.add(0, 1.1, 0.5, Vec3(k % 6, k / 6 % 6, k / 36));
  gas.set_box(Vec3(side, 0, 0), Vec3(0, side, 0), Vec3(0, 0, side));
  gas.set_method(DCHNonbondedForce::CutoffPeriodic, cutoff);
  const auto correction = [&](double first_sigma) {
    for (int k = 0; k < 216; ++k)
      gas.force->setParticleParameters(k, 0, k % 2 == 0 ? first_sigma : 1.0, k % 2 == 0 ? 0.5 : 1.0);
    gas.force->setUseDispersionCorrection(false);
    const Evaluation without = evaluate(gas, GetParam());
    gas.force->setUseDispersionCorrection(true);
    const Evaluation with = evaluate(gas, GetParam());
    for (std::size_t i = 0; i < with.forces.size(); ++i)
      expect_near(without.forces[i], with.forces[i], tolerance(), "force");
    return with.energy - without.energy;
  };
  // The mean over pairs of kinds, self-pairs included, of the integral of 16 pi n^2 eps (s^12/r^10 -
  // s^6/r^4).
  const auto expected = [&](double first_sigma) {
    const auto tail = [&](double sigma, double epsilon) {
      return epsilon * (std::pow(sigma, 12) / (9 * std::pow(cutoff, 9)) -
                        std::pow(sigma, 6) / (3 * std::pow(cutoff, 3)));
    };
    const double pairs = 216.0 * 217 / 2, same = 108.0 * 109 / 2, mixed = 108.0 * 108;
    const double mean =
        (same * (tail(first_sigma, 0.5) + tail(1, 1)) + mixed * tail((first_sigma + 1) / 2, std::sqrt(0.5))) /
        pairs;
    return 8 * 216.0 * 216.0 * M_PI * mean / (side * side * side);
  };
  expect_near(expected(1.1), correction(1.1), 1e-4, "two kinds");
  expect_near(expected(1.0), correction(1.0), 1e-4, "after a change");

  gas.force->setUseSwitchingFunction(true);
  gas.force->setSwitchingDistance(1.5);
  expect_near(native(gas), evaluate(gas, GetParam()), tolerance(), "with a switch");
}

TEST_P(NonbondedTest, TwoForcesAndGroups) {
  Case two;
  add_dumbbells(two, 50, 4, 3);
  two.set_method(DCHNonbondedForce::CutoffNonPeriodic, 1.0);
  auto* const second = new DCHNonbondedForce();
  for (int i = 0; i < 100; ++i) second->addParticle(0.1, 0.2, 0.4);
  second->setForceGroup(3);
  two.system.addForce(second);
  auto* const bonds = new OpenMM::HarmonicBondForce();
  bonds->addBond(0, 1, 0.2, 100);
  bonds->setForceGroup(5);
  two.system.addForce(bonds);

  const Evaluation first_alone = all_pairs(*two.force, two.positions, nullptr);
  const Evaluation second_alone = all_pairs(*second, two.positions, nullptr);
  Host host(two.system, GetParam());
  host->setPositions(two.positions);
  expect_near(first_alone, host.evaluate(1 << 0), tolerance(), "first");
  expect_near(second_alone, host.evaluate(1 << 3), tolerance(), "second");
  const Evaluation all = host.evaluate();
  const Evaluation parts[3] = {host.evaluate(1 << 0), host.evaluate(1 << 3), host.evaluate(1 << 5)};
  expect_near(parts[0].energy + parts[1].energy + parts[2].energy, all.energy, tolerance(), "sum");
  for (std::size_t i = 0; i < all.forces.size(); ++i)
    expect_near(parts[0].forces[i] + parts[1].forces[i] + parts[2].forces[i], all.forces[i], tolerance(),
                "sum");
}

// The native force beside ours, in one System: neither disturbs the other.
TEST_P(NonbondedTest, BesideTheNativeForce) {
  Case both;
  const double side = 8;
  add_dumbbells(both, 100, side, 5);
  both.set_box(Vec3(side, 0, 0), Vec3(0, side, 0), Vec3(0, 0, side));
  both.set_method(DCHNonbondedForce::CutoffPeriodic, 1.5);
  auto* const own = new OpenMM::NonbondedForce(both.force->getParameters());
  own->setNonbondedMethod(OpenMM::NonbondedForce::CutoffNonPeriodic);
  own->setForceGroup(1);
  both.system.addForce(own);
  const Evaluation expected = native(both);
  Host host(both.system, GetParam());
  host->setPositions(both.positions);
  expect_near(expected, host.evaluate(1 << 0), tolerance(), "ours");
  Case native_alone;
  add_dumbbells(native_alone, 100, side, 5);
  native_alone.set_method(DCHNonbondedForce::CutoffNonPeriodic, 1.5);
  expect_near(native(native_alone), host.evaluate(1 << 1), 1e-5, "OpenMM's");
}

}  // namespace
}  // namespace OpenMMDCH
