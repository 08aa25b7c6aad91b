// SPDX-License-Identifier: MIT
//
// Lattice sums by the drop-in: each part against OpenMM, and the whole against a crystal.
#include "drop_in_case.hpp"

namespace OpenMMDCH {
namespace {

class LatticeSumTest : public DropInTest {};
DCH_ON_EACH_PLATFORM(LatticeSumTest);

TEST_P(LatticeSumTest, PmeEqualsOpenMMInEachForceGroup) {
  const std::unique_ptr<RandomSystem> water = make_water(8);
  water->force->setForceGroup(2);
  for (const bool direct : {true, false})
    for (const int reciprocal : {-1, 3}) {
      water->force->setIncludeDirectSpace(direct);
      water->force->setReciprocalSpaceForceGroup(reciprocal);
      Host native(water->system, "Reference");
      const std::unique_ptr<Host> host = drop_in(water->system);
      native->setPositions(water->positions);
      (*host)->setPositions(water->positions);
      for (const int groups : {-1, 1 << 2, 1 << 3, 1 << 4}) {
        const Evaluation expected = native.evaluate(groups), found = host->evaluate(groups);
        const std::string what = "direct " + std::to_string(direct) + ", reciprocal group " +
                                 std::to_string(reciprocal) + ", groups " + std::to_string(groups);
        expect_energy(expected, found, what);
        if (expected.energy == 0) continue;
        EXPECT_LT(force_error(expected, found), GetParam() == "Reference" ? 1e-9 : 5e-6) << what;
      }
    }
}

TEST_P(LatticeSumTest, PmeParametersAreThoseOfOpenMM) {
  const std::unique_ptr<RandomSystem> water = make_water(8);
  water->force->setPMEParameters(0, 0, 0, 0);  // OpenMM chooses
  const auto parameters_in = [&](Host& host) {
    double alpha;
    int n[3];
    force_in(host).getPMEParametersInContext(*host, alpha, n[0], n[1], n[2]);
    return std::vector<double>{alpha, 1.0 * n[0], 1.0 * n[1], 1.0 * n[2]};
  };
  Host native(water->system, GetParam());
  const std::vector<double> expected = parameters_in(native), found = parameters_in(*drop_in(water->system));
  EXPECT_EQ(found[0], expected[0]);
  // On the CPU platform the next number without prime factors over 7.
  for (std::size_t axis = 1; axis < 4; ++axis) {
    EXPECT_GE(found[axis], expected[axis]);
    EXPECT_LE(found[axis], expected[axis] + (GetParam() == "Reference" ? 0 : 4));
  }
  water->force->setPMEParameters(3.1, 24, 25, 27);
  EXPECT_EQ(parameters_in(*drop_in(water->system)), (std::vector<double>{3.1, 24, 25, 27}));
  water->force->setNonbondedMethod(NonbondedForce::CutoffPeriodic);
  EXPECT_THAT(message_of([&] { parameters_in(*drop_in(water->system)); }),
              testing::HasSubstr("not using PME"));
}

TEST_P(LatticeSumTest, OffsetsAndUpdatesActInBothPartsOfPme) {
  const std::unique_ptr<RandomSystem> water = make_water(8);
  water->force->addGlobalParameter("lambda", 0);
  for (int i = 0; i < 30; ++i)
    water->force->addParticleParameterOffset("lambda", i, i % 3 == 0 ? 0.4 : -0.2, 0, 0);
  Host native(water->system, "Reference");
  const std::unique_ptr<Host> host = drop_in(water->system);
  const auto expect_equal = [&](const std::string& what) {
    const Evaluation expected = native.evaluate(water->positions), found = host->evaluate(water->positions);
    expect_energy(expected, found, what);
    EXPECT_LT(force_error(expected, found), GetParam() == "Reference" ? 1e-9 : 5e-6) << what;
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
      force->setParticleParameters(i, i % 3 == 0 ? -1 : 0.5, 0.3, i % 2 == 0 ? 0.5 : 0);
  water->force->updateParametersInContext(*native);
  copy.updateParametersInContext(**host);
  expect_equal("updated");
}

/// Two hundred particles that are bound to nobody, wherever, whichever box: the lists follow.
TEST_P(LatticeSumTest, PmeFollowsMotionAndBox) {
  const std::unique_ptr<RandomSystem> made = random_system(NonbondedForce::PME, 77);
  const std::unique_ptr<Host> host = drop_in(made->system);
  const OracleSplittings splittings = splittings_of(*host);
  dch::scenes::Random random(78);
  const OpenMM::NonbondedForce oracle = with_offsets_added(*made->force);
  for (int step = 0; step < 15; ++step) {
    const double scale = 1 + 0.02 * step;
    for (Vec3& p : made->positions)
      p = p * (step == 0 ? 1 : scale / (scale - 0.02)) + random.vector<Vec3>(-1, 1) * 0.003;
    const Vec3 now[3] = {made->box[0] * scale, made->box[1] * scale, made->box[2] * scale};
    (*host)->setPeriodicBoxVectors(now[0], now[1], now[2]);
    (*host)->setPositions(made->positions);
    const Evaluation found = host->evaluate(1 << 0);
    // A pair at the cutoff may be taken or not in single precision.
    EXPECT_LT(force_error(all_pairs(oracle, made->positions, now, splittings), found), 10 * tolerance())
        << step;
  }
}

TEST_P(LatticeSumTest, EwaldEqualsOpenMMInEachForceGroup) {
  const std::unique_ptr<RandomSystem> water = make_water(6);
  make_rectangular(*water);
  water->force->setNonbondedMethod(NonbondedForce::Ewald);
  water->force->addGlobalParameter("lambda", 0.5);
  water->force->addParticleParameterOffset("lambda", 3, 0.4, 0, 0);
  water->force->setReciprocalSpaceForceGroup(3);
  Host native(water->system, "Reference");
  const std::unique_ptr<Host> host = drop_in(water->system);
  const NonbondedStatus status = nonbondedStatus(**host).at(0);
  EXPECT_EQ(status.direct, "DCH");
  EXPECT_EQ(status.reciprocal, "DCH");
  EXPECT_EQ(status.reason, "");
  native->setPositions(water->positions);
  (*host)->setPositions(water->positions);
  for (const int groups : {-1, 1, 1 << 3}) {
    const Evaluation expected = native.evaluate(groups), found = host->evaluate(groups);
    expect_energy(expected, found, "groups " + std::to_string(groups));
    EXPECT_LT(force_error(expected, found), GetParam() == "Reference" ? 1e-9 : 5e-6) << groups;
  }
  EXPECT_THAT(message_of([&] { splitting_of_pme(*host); }), testing::HasSubstr("not using PME"));
}

/// By Madelung's constant of rock salt.
TEST_P(LatticeSumTest, LatticeSumsGiveTheEnergyOfACrystal) {
  const double apart = 0.282, madelung = 1.7475645946;
  for (const auto method : {NonbondedForce::Ewald, NonbondedForce::PME}) {
    RandomSystem salt;
    for (int k = 0; k < 1000; ++k) {
      const int x = k % 10, y = k / 10 % 10, z = k / 100;
      salt.system.addParticle(1);
      salt.force->addParticle((x + y + z) % 2 == 0 ? 1 : -1, 1, 0);
      salt.positions.push_back(Vec3(x, y, z) * apart);
    }
    salt.system.setDefaultPeriodicBoxVectors(Vec3(10 * apart, 0, 0), Vec3(0, 10 * apart, 0),
                                             Vec3(0, 0, 10 * apart));
    salt.force->setNonbondedMethod(method);
    salt.force->setEwaldErrorTolerance(1e-5);
    salt.system.addForce(salt.force);
    const Evaluation found = drop_in(salt.system)->evaluate(salt.positions);
    EXPECT_NEAR(found.energy / (500 * kCoulomb / apart), -madelung, 1e-5 * madelung) << method;
    for (const Vec3& force : found.forces)
      ASSERT_LT(std::sqrt(force.dot(force)), 1e-5 * kCoulomb / (apart * apart));
  }
}

/// Where OpenMM goes on with the periods of another box.
TEST_P(LatticeSumTest, EwaldRefusesABoxThatIsNotRectangularAnyMore) {
  const std::unique_ptr<RandomSystem> water = make_water(6);
  EXPECT_NE(message_of([&] {
              water->force->setNonbondedMethod(NonbondedForce::Ewald);
              drop_in(water->system);
            }),
            "");
  make_rectangular(*water);
  const std::unique_ptr<Host> host = drop_in(water->system);
  host->evaluate(water->positions);
  (*host)->setPeriodicBoxVectors(water->box[0], water->box[1] + water->box[0] * 0.1, water->box[2]);
  EXPECT_THAT(message_of([&] { host->evaluate(); }), testing::HasSubstr("rectangular"));
}

}  // namespace
}  // namespace OpenMMDCH
