// SPDX-License-Identifier: MIT
//
// OpenMM's own NonbondedForce by the drop-in: what it covers, when it acts, and what it refuses.
#include "drop_in_case.hpp"

namespace OpenMMDCH {
namespace {

DCH_ON_EACH_PLATFORM(DropInTest);

TEST_P(DropInTest, WhatIsNotCoveredIsOpenMMsAndNotSaidTwice) {
  const std::unique_ptr<RandomSystem> water = make_water(6);
  water->force->setPMEParameters(11, 30, 30, 30);
  testing::internal::CaptureStderr();
  const std::unique_ptr<Host> host = drop_in(water->system);
  drop_in(water->system);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_LE(std::count(said.begin(), said.end(), '\n'),
            1);  // another test of this process may have been first
  const NonbondedStatus status = nonbondedStatus(**host).at(0);
  EXPECT_EQ(status.direct, "OpenMM");
  EXPECT_EQ(status.reciprocal, "OpenMM");
  EXPECT_THAT(status.reason, testing::HasSubstr("over 6"));
  Host native(water->system, GetParam());
  EXPECT_LT(force_error(native.evaluate(water->positions), host->evaluate(water->positions)), 1e-4);
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
