// SPDX-License-Identifier: MIT
//
// OpenMM's own NonbondedForce by the drop-in: against all pairs in double, and against OpenMM.
#include "random_systems.hpp"

namespace OpenMMDCH {
namespace {

using OpenMM::NonbondedForce;

class DropInTest : public OnPlatform {
 protected:
  /// In single precision forces are within 5e-6 of their root mean square.
  double tolerance() const { return GetParam() == "Reference" ? 1e-10 : 5e-6; }
  std::unique_ptr<Host> drop_in(const OpenMM::System& system) const {
    return std::make_unique<Host>(system, kDropIn + GetParam());
  }
  /// Energies are small sums of large ones: in single precision within 1e-5 kJ/mol an atom.
  void expect_energy(const Evaluation& expected, const Evaluation& found, const std::string& what) const {
    const double allowed = 1e-5 * static_cast<double>(expected.forces.size());
    if (GetParam() == "Reference")
      expect_near(expected.energy, found.energy, 1e-9, what);
    else
      EXPECT_NEAR(found.energy, expected.energy, allowed) << what;
  }
};
DCH_ON_EACH_PLATFORM(DropInTest);

/// Of OpenMM's choice.
double splitting_of(Host& host) {
  const auto& force = dynamic_cast<const NonbondedForce&>(host->getSystem().getForce(0));
  double alpha = 0;
  int nx, ny, nz;
  if (force.getNonbondedMethod() == NonbondedForce::PME)
    force.getPMEParametersInContext(*host, alpha, nx, ny, nz);
  return alpha;
}

TEST_P(DropInTest, RandomSystemsEqualAllPairs) {
  for (const auto method : {NonbondedForce::NoCutoff, NonbondedForce::CutoffNonPeriodic,
                            NonbondedForce::CutoffPeriodic, NonbondedForce::PME})
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const std::unique_ptr<RandomSystem> made = random_system(method, seed);
      const std::unique_ptr<Host> host = drop_in(made->system);
      ASSERT_EQ(nonbondedStatus(**host).at(0).direct, "DCH");
      (*host)->setPositions(made->positions);
      const Vec3* const box = made->force->usesPeriodicBoundaryConditions() ? made->box : nullptr;
      const Evaluation found = host->evaluate(1 << 0);
      const Evaluation expected =
          all_pairs(with_offsets_added(*made->force), made->positions, box, splitting_of(*host));
      const std::string what = "method " + std::to_string(method) + ", seed " + std::to_string(seed);
      EXPECT_LT(force_error(expected, found), tolerance()) << what;
      expect_energy(expected, found, what);
    }
}

TEST_P(DropInTest, PmeEqualsOpenMMInEachForceGroup) {
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

TEST_P(DropInTest, PmeParametersAreThoseOfOpenMM) {
  const std::unique_ptr<RandomSystem> water = make_water(8);
  water->force->setPMEParameters(0, 0, 0, 0);  // OpenMM chooses
  const auto parameters_in = [&](Host& host) {
    double alpha;
    int n[3];
    const auto& force = dynamic_cast<const NonbondedForce&>(host->getSystem().getForce(0));
    force.getPMEParametersInContext(*host, alpha, n[0], n[1], n[2]);
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

TEST_P(DropInTest, OffsetsAndUpdatesActInBothPartsOfPme) {
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
TEST_P(DropInTest, PmeFollowsMotionAndBox) {
  const std::unique_ptr<RandomSystem> made = random_system(NonbondedForce::PME, 77);
  const std::unique_ptr<Host> host = drop_in(made->system);
  const double splitting = splitting_of(*host);
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
    EXPECT_LT(force_error(all_pairs(oracle, made->positions, now, splitting), found), 10 * tolerance())
        << step;
  }
}

TEST_P(DropInTest, WhatIsNotCoveredIsOpenMMsAndNotSaidTwice) {
  const std::unique_ptr<RandomSystem> water = make_water(6);
  // Ewald sums are for rectangular boxes only.
  water->system.setDefaultPeriodicBoxVectors(Vec3(water->box[0][0], 0, 0), Vec3(0, water->box[1][1], 0),
                                             Vec3(0, 0, water->box[2][2]));
  const std::pair<NonbondedForce::NonbondedMethod, std::string> methods[] = {
      {NonbondedForce::Ewald, "Ewald"}, {NonbondedForce::LJPME, "LJPME"}};
  for (const auto& [method, name] : methods) {
    water->force->setNonbondedMethod(method);
    testing::internal::CaptureStderr();
    const std::unique_ptr<Host> host = drop_in(water->system);
    drop_in(water->system);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_LE(std::count(said.begin(), said.end(), '\n'),
              1);  // another test of this process may have been first
    const NonbondedStatus status = nonbondedStatus(**host).at(0);
    EXPECT_EQ(status.direct, "OpenMM");
    EXPECT_EQ(status.reciprocal, "OpenMM");
    EXPECT_THAT(status.reason, testing::HasSubstr(name));
    Host native(water->system, GetParam());
    EXPECT_LT(force_error(native.evaluate(water->positions), host->evaluate(water->positions)), 1e-4) << name;
  }
}

/// Excluded particles at the same place, and others so near that single precision has no number for it.
TEST_P(DropInTest, WithoutACutoffParticlesMayCoincideOrNearlySo) {
  const std::unique_ptr<RandomSystem> water = make_water(6);
  water->force->setNonbondedMethod(NonbondedForce::NoCutoff);
  const std::unique_ptr<Host> host = drop_in(water->system);
  EXPECT_EQ(nonbondedStatus(**host).at(0).direct, "DCH");
  EXPECT_EQ(nonbondedStatus(**host).at(0).reciprocal, "");
  for (const double apart : {0.1, 1e-6}) {
    water->positions[1] = water->positions[0];
    water->positions[300] = water->positions[600] + Vec3(apart, 0, 0);
    const Evaluation found = host->evaluate(water->positions);
    for (const Vec3& force : found.forces) ASSERT_TRUE(std::isfinite(force.dot(force)));
    std::vector<Vec3> moved = water->positions;
    EXPECT_LT(force_error(all_pairs(*water->force, water->positions, nullptr), found), tolerance()) << apart;
  }
}

TEST_P(DropInTest, EachContextKeepsWhatItWasMadeWith) {
  const std::unique_ptr<RandomSystem> water = make_water(6);
  EXPECT_FALSE(isDropInEnabled());
  Host before(water->system, GetParam());
  EXPECT_EQ(nonbondedStatus(*before).at(0).direct, "OpenMM");
  EXPECT_THAT(nonbondedStatus(*before).at(0).reason, testing::HasSubstr("not enabled"));
  const std::unique_ptr<Host> during = drop_in(water->system);
  EXPECT_FALSE(isDropInEnabled());
  EXPECT_EQ(countOfForcesBeforeDropIn(), 0);
  const NonbondedStatus status = nonbondedStatus(**during).at(0);
  EXPECT_EQ(status.direct, "DCH");
  EXPECT_EQ(status.reciprocal, GetParam() == "Reference" ? "OpenMM" : "DCH");
  EXPECT_EQ(status.reason, "");
  (*during)->reinitialize();
  EXPECT_EQ(nonbondedStatus(**during).at(0).direct, "OpenMM");
  const DropInEnabled enabled;
  before->reinitialize();
  EXPECT_EQ(nonbondedStatus(*before).at(0).direct, "DCH");
  EXPECT_LT(force_error(during->evaluate(water->positions), before.evaluate(water->positions)), 1e-4);
}

TEST_P(DropInTest, BadInputIsRefusedAsByOpenMM) {
  const std::unique_ptr<RandomSystem> water = make_water(6);
  const auto complaint = [&](const std::string& way) {
    return message_of([&] { Host(water->system, way).evaluate(water->positions); });
  };
  const auto expect_same = [&](const std::string& what) {
    EXPECT_NE(complaint(GetParam()), "") << what;
    EXPECT_EQ(complaint(kDropIn + GetParam()), complaint(GetParam())) << what;
  };
  EXPECT_EQ(complaint(kDropIn + GetParam()), "");
  water->force->setCutoffDistance(1.5);
  expect_same("cutoff");
  water->force->setCutoffDistance(0.6);
  water->force->setParticleParameters(3, 0, -1, 0);
  expect_same("sigma");
  water->force->setParticleParameters(3, 0, 1, 0);
  water->force->setExceptionParameters(1, 0, 1, 0, 1, 0);
  EXPECT_THAT(complaint(kDropIn + GetParam()), testing::HasSubstr("particles 0 and 1"));
  water->force->setExceptionParameters(1, 0, 2, 0, 1, 0);
  water->positions[5][2] = std::nan("");
  EXPECT_NE(complaint(kDropIn + GetParam()), "") << "position";
}

}  // namespace
}  // namespace OpenMMDCH
