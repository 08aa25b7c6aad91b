// SPDX-License-Identifier: MIT
//
// Lattice sums of dispersion (LJPME) by the drop-in: each part against OpenMM, and the whole against sums
// over images.
#include "drop_in_case.hpp"

namespace OpenMMDCH {
namespace {

class DispersionSumTest : public DropInTest {
 protected:
  double tolerance_to_openmm() const { return GetParam() == "Reference" ? 1e-9 : 5e-6; }
};
DCH_ON_EACH_PLATFORM(DispersionSumTest);

/// Molecules away from their lattice, where forces of dispersion would cancel.
std::unique_ptr<RandomSystem> make_shaken_water(int per_side) {
  std::unique_ptr<RandomSystem> water = make_water(per_side);
  dch::scenes::Random random(6);
  for (std::size_t i = 0; i < water->positions.size(); i += 3) {
    const Vec3 step = random.vector<Vec3>(-0.03, 0.03);
    for (std::size_t atom = i; atom < i + 3; ++atom) water->positions[atom] += step;
  }
  return water;
}

/// Atoms of oxygen act by dispersion, and so do some of hydrogen, in other kinds of which there are many or
/// few.
std::unique_ptr<RandomSystem> make_case(int per_side, bool charged, bool many_kinds) {
  std::unique_ptr<RandomSystem> water = make_shaken_water(per_side);
  water->force->setNonbondedMethod(NonbondedForce::LJPME);
  water->force->setLJPMEParameters(4.5, 28, 30, 32);
  for (int i = 0; i < water->force->getNumParticles(); ++i) {
    const double charge = charged ? (i % 3 == 0 ? -0.8 : 0.4) : 0;
    if (i % 3 == 0)
      water->force->setParticleParameters(i, charge, 0.315, 0.64);
    else
      water->force->setParticleParameters(i, charge, 0.1 + (many_kinds ? 0.01 * (i % 7) : 0.0),
                                          i % 2 == 0 ? 0.1 : 0.0);
  }
  return water;
}

TEST_P(DispersionSumTest, EqualsOpenMMInEachForceGroup) {
  for (const bool charged : {true, false})
    for (const bool many_kinds : {true, false}) {
      const std::unique_ptr<RandomSystem> water = make_case(8, charged, many_kinds);
      water->force->setForceGroup(2);
      for (const int reciprocal : {-1, 3}) {
        water->force->setReciprocalSpaceForceGroup(reciprocal);
        Host native(water->system, "Reference");
        const std::unique_ptr<Host> host = drop_in(water->system);
        EXPECT_EQ(nonbondedStatus(**host).at(0).direct, "DCH");
        EXPECT_EQ(nonbondedStatus(**host).at(0).reciprocal, GetParam() == "CPU" ? "DCH" : "OpenMM");
        EXPECT_EQ(nonbondedStatus(**host).at(0).reason, "");
        native->setPositions(water->positions);
        (*host)->setPositions(water->positions);
        for (const int groups : {-1, 1 << 2, 1 << 3, 1 << 4}) {
          const Evaluation expected = native.evaluate(groups), found = host->evaluate(groups);
          const std::string what = "charged " + std::to_string(charged) + ", many kinds " +
                                   std::to_string(many_kinds) + ", reciprocal group " +
                                   std::to_string(reciprocal) + ", groups " + std::to_string(groups);
          expect_energy(expected, found, what);
          if (expected.energy == 0) continue;
          EXPECT_LT(force_error(expected, found), tolerance_to_openmm()) << what;
        }
      }
    }
}

TEST_P(DispersionSumTest, ParametersAreThoseOfOpenMM) {
  const std::unique_ptr<RandomSystem> water = make_case(8, true, false);
  EXPECT_EQ(parameters_of_ljpme(*drop_in(water->system)), (std::vector<double>{4.5, 28, 30, 32}));
  EXPECT_EQ(splitting_of_pme(*drop_in(water->system)), 4.3);
  water->force->setLJPMEParameters(0, 0, 0, 0);  // OpenMM chooses
  // OpenMM 8.1 with its own kernels of reciprocal space for the CPU platform stops where it is asked for
  // these.
  Host native(water->system, "Reference");
  native.evaluate(water->positions);  // before, OpenMM 7.7 does not know
  const std::vector<double> expected = parameters_of_ljpme(native);
  const std::vector<double> found = parameters_of_ljpme(*drop_in(water->system));
  EXPECT_EQ(found[0], expected[0]);
  // On the CPU platform the next number without prime factors over 7.
  for (std::size_t axis = 1; axis < 4; ++axis) {
    EXPECT_GE(found[axis], expected[axis]);
    EXPECT_LE(found[axis], expected[axis] + (GetParam() == "Reference" ? 0 : 4));
  }
  water->force->setNonbondedMethod(NonbondedForce::PME);
  EXPECT_THAT(message_of([&] { parameters_of_ljpme(*drop_in(water->system)); }),
              testing::HasSubstr("not using LJPME"));
}

TEST_P(DispersionSumTest, OffsetsAndUpdatesActInBothParts) {
  const std::unique_ptr<RandomSystem> water = make_case(6, true, true);
  water->force->addGlobalParameter("lambda", 0);
  for (int i = 0; i < 30; ++i)
    water->force->addParticleParameterOffset("lambda", i, i % 3 == 0 ? 0.4 : -0.2, 0.02, 0.3);
  water->force->setExceptionParameters(2, 1, 2, 0, 0.1, 0);
  water->force->addExceptionParameterOffset("lambda", 2, 0.1, 0.02, 0.2);
  Host native(water->system, "Reference");
  const std::unique_ptr<Host> host = drop_in(water->system);
  const auto expect_equal = [&](const std::string& what) {
    const Evaluation expected = native.evaluate(water->positions), found = host->evaluate(water->positions);
    expect_energy(expected, found, what);
    EXPECT_LT(force_error(expected, found), tolerance_to_openmm()) << what;
  };
  expect_equal("at first");
  for (const double lambda : {0.5, 1.0}) {
    native->setParameter("lambda", lambda);
    (*host)->setParameter("lambda", lambda);
    expect_equal("lambda " + std::to_string(lambda));
  }
  // The drop-in's Context has a copy of the System.
  auto& copy =
      const_cast<NonbondedForce&>(dynamic_cast<const NonbondedForce&>((*host)->getSystem().getForce(0)));
  for (NonbondedForce* const force : {water->force, &copy})
    for (int i = 0; i < 60; ++i)
      force->setParticleParameters(i, i % 3 == 0 ? -1 : 0.5, 0.2, i % 2 == 0 ? 0.5 : 0);
  water->force->updateParametersInContext(*native);
  copy.updateParametersInContext(**host);
  expect_equal("updated");
}

TEST_P(DispersionSumTest, FollowsMotionAndBox) {
  const std::unique_ptr<RandomSystem> water = make_case(6, true, true);
  Host native(water->system, "Reference");
  const std::unique_ptr<Host> host = drop_in(water->system);
  dch::scenes::Random random(78);
  for (int step = 0; step < 6; ++step) {
    const double scale = 1 + 0.01 * step;
    for (Vec3& p : water->positions) p += random.vector<Vec3>(-1, 1) * 0.003;
    Evaluation both[2];
    for (Host* const each : {&native, host.get()}) {
      (*each)->setPeriodicBoxVectors(water->box[0] * scale, water->box[1] * scale, water->box[2] * scale);
      both[each == &native ? 0 : 1] = each->evaluate(water->positions);
    }
    // A pair at the cutoff may be taken or not in single precision.
    EXPECT_LT(force_error(both[0], both[1]), 10 * tolerance_to_openmm()) << step;
  }
}

/// Where particles are alike the mixing rules of pairs and of the grid agree, and the sum is over all images:
/// by the lattice sum of 1/r^6 of a simple cubic crystal.
TEST_P(DispersionSumTest, GivesTheEnergyOfACrystal) {
  const double apart = 0.4, sigma = 0.34, epsilon = 0.996, cutoff = 1.1, sum_of_6 = 8.40192397482754;
  RandomSystem crystal;
  for (int k = 0; k < 512; ++k) {
    crystal.system.addParticle(1);
    crystal.force->addParticle(0, sigma, epsilon);
    crystal.positions.push_back(Vec3(k % 8, k / 8 % 8, k / 64) * apart);
  }
  crystal.system.setDefaultPeriodicBoxVectors(Vec3(8 * apart, 0, 0), Vec3(0, 8 * apart, 0),
                                              Vec3(0, 0, 8 * apart));
  crystal.force->setNonbondedMethod(NonbondedForce::LJPME);
  crystal.force->setCutoffDistance(cutoff);
  crystal.force->setLJPMEParameters(3.2, 64, 64, 64);
  crystal.system.addForce(crystal.force);
  const std::unique_ptr<Host> host = drop_in(crystal.system);
  const Evaluation found = host->evaluate(crystal.positions);
  const double c6 = 4 * epsilon * std::pow(sigma, 6), c12 = c6 * std::pow(sigma, 6);
  double repulsion = 0, near = 0;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z) {
        const double r = apart * std::sqrt(x * x + y * y + z * z);
        if (r == 0 || r >= cutoff) continue;
        repulsion += c12 / std::pow(r, 12);
        near += 1;
      }
  const double shift = c12 / std::pow(cutoff, 12) - c6 / std::pow(cutoff, 6) +
                       far_dispersion(c6, splittings_of(*host).dispersion, cutoff).energy;
  const double expected = 256 * (repulsion - c6 * sum_of_6 / std::pow(apart, 6) - near * shift);
  EXPECT_NEAR(found.energy / expected, 1, 2e-6);
  for (const Vec3& force : found.forces) ASSERT_LT(std::sqrt(force.dot(force)), 1e-3);
}

/// Particles that are alike cannot tell how their sum was split.
TEST_P(DispersionSumTest, ForcesDoNotDependOnTheSplitting) {
  std::vector<Evaluation> found;
  for (const double splitting : {4.2, 5.2}) {
    const std::unique_ptr<RandomSystem> water = make_shaken_water(8);
    water->force->setNonbondedMethod(NonbondedForce::LJPME);
    water->force->setCutoffDistance(1);
    water->force->setPMEParameters(splitting, 64, 64, 64);
    water->force->setLJPMEParameters(splitting, 64, 64, 64);
    for (int i = 0; i < water->force->getNumParticles(); ++i)
      water->force->setParticleParameters(i, 0, 0.315, i % 3 == 0 ? 0.64 : 0);
    found.push_back(drop_in(water->system)->evaluate(water->positions));
  }
  EXPECT_LT(force_error(found[1], found[0]), 4e-5);
}

/// Of OpenMM's error tolerance, which chooses splitting and grid.
TEST_P(DispersionSumTest, ErrorsFollowTheTolerance) {
  const std::unique_ptr<RandomSystem> water = make_case(6, true, false);
  water->force->setPMEParameters(0, 0, 0, 0);
  water->force->setLJPMEParameters(0, 0, 0, 0);
  const auto at = [&](double tolerance) {
    water->force->setEwaldErrorTolerance(tolerance);
    return drop_in(water->system)->evaluate(water->positions);
  };
  const Evaluation expected = at(2e-6);
  double last = 1;
  for (const double tolerance : {2e-3, 2e-4}) {
    const double error = force_error(expected, at(tolerance));
    EXPECT_LT(error, 5 * tolerance);
    EXPECT_LT(error, last / 2);
    last = error;
  }
}

/// Of energies that are shifted, since those of charges jump at the cutoff.
TEST_P(DispersionSumTest, ForcesAreSlopesOfTheEnergy) {
  const std::unique_ptr<RandomSystem> water = make_case(6, false, true);
  const std::unique_ptr<Host> host = drop_in(water->system);
  const Evaluation here = host->evaluate(water->positions);
  dch::scenes::Random random(3);
  std::vector<Vec3> way;
  double slope = 0, size = 0;
  for (std::size_t i = 0; i < here.forces.size(); ++i) {
    way.push_back(random.vector<Vec3>(-1, 1));
    slope -= way.back().dot(here.forces[i]);
    size += std::abs(way.back().dot(here.forces[i]));
  }
  double energies[2];
  const double step = GetParam() == "Reference" ? 1e-5 : 1e-4;
  for (const int side : {0, 1}) {
    std::vector<Vec3> moved = water->positions;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += way[i] * (side == 0 ? -step : step);
    energies[side] = host->evaluate(moved).energy;
  }
  EXPECT_NEAR((energies[1] - energies[0]) / (2 * step), slope, 2e-5 * size);
}

/// Excluded particles at the same place have an energy there, and no force on each other.
TEST_P(DispersionSumTest, ExcludedParticlesMayCoincide) {
  const std::unique_ptr<RandomSystem> water = make_case(6, false, true);
  const std::unique_ptr<Host> host = drop_in(water->system);
  water->positions[4] = water->positions[3] + Vec3(1e-3, 0, 0);
  const Evaluation near = host->evaluate(water->positions);
  water->positions[4] = water->positions[3];
  const Evaluation found = host->evaluate(water->positions);
  EXPECT_NEAR(found.energy, near.energy, 0.5);
  EXPECT_LT(force_error(near, found), 0.02);
}

TEST_P(DispersionSumTest, ASwitchIsLeftToOpenMM) {
  const std::unique_ptr<RandomSystem> water = make_case(6, true, true);
  water->force->setUseSwitchingFunction(true);
  water->force->setSwitchingDistance(0.5);
  const NonbondedStatus status = nonbondedStatus(**drop_in(water->system)).at(0);
  EXPECT_EQ(status.direct, "OpenMM");
  EXPECT_THAT(status.reason, testing::HasSubstr("switching function with the method LJPME"));
}

TEST(DispersionSumThreadsTest, AnyNumberOfThreadsGivesTheSameBits) {
  dch_platforms();
  const std::unique_ptr<RandomSystem> water = make_case(8, true, true);
  std::vector<Evaluation> found;
  for (const char* const threads : {"1", "2", "3"})
    found.push_back(Host(water->system, kDropIn + "CPU", {{"Threads", threads}}).evaluate(water->positions));
  for (const Evaluation& each : found) {
    EXPECT_EQ(each.energy, found[0].energy);
    EXPECT_EQ(each.forces, found[0].forces);
  }
}

}  // namespace
}  // namespace OpenMMDCH
