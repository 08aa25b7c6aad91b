// SPDX-License-Identifier: MIT
//
// Parameters that change: offsets by global parameters, updateParametersInContext, copies of OpenMM's force.
#include "all_pairs_oracle.hpp"

namespace OpenMMDCH {
namespace {

class ParametersTest : public OnPlatform {};
DCH_ON_EACH_PLATFORM(ParametersTest);

/// Four particles on a line, the first two with an exception.
void make_line(Case& line) {
  for (int i = 0; i < 4; ++i) line.add(i == 3 ? -1.0 : 0.5 + i, 1 - 0.1 * i, 0.5 + 0.1 * i, Vec3(i, 0, 0));
  line.force->addException(0, 1, 1, 1.5, 1);
  line.force->addException(2, 3, 0.5, 0.5, 1.5);
}

TEST_P(ParametersTest, OffsetsFollowGlobalParameters) {
  Case line;
  make_line(line);
  line.force->addGlobalParameter("p1", 0);
  line.force->addGlobalParameter("p2", 1);
  line.force->addParticleParameterOffset("p1", 0, 3, 0.5, 0.5);
  line.force->addParticleParameterOffset("p2", 1, 1, 1, 2);
  line.force->addParticleParameterOffset("p1", 1, 0.5, 0, 0);
  line.force->addExceptionParameterOffset("p1", 1, 0.5, 0.5, 1.5);
  Host host(line.system, GetParam());
  host->setPositions(line.positions);
  for (const double p1 : {0.0, 0.5, 0.5, -0.2}) {
    for (const double p2 : {1.0, 1.5}) {
      host->setParameter("p1", p1);
      host->setParameter("p2", p2);
      Case shifted;
      make_line(shifted);
      shifted.force->setParticleParameters(0, 0.5 + 3 * p1, 1 + 0.5 * p1, 0.5 + 0.5 * p1);
      shifted.force->setParticleParameters(1, 1.5 + p2 + 0.5 * p1, 0.9 + p2, 0.6 + 2 * p2);
      shifted.force->setExceptionParameters(1, 2, 3, 0.5 + 0.5 * p1, 0.5 + 0.5 * p1, 1.5 + 1.5 * p1);
      expect_near(all_pairs(*shifted.force, shifted.positions, nullptr), host.evaluate(), tolerance(),
                  "p1 = " + std::to_string(p1) + ", p2 = " + std::to_string(p2));
    }
  }
}

TEST_P(ParametersTest, OffsetsMayNotMakeParametersNegative) {
  Case line;
  make_line(line);
  line.force->addGlobalParameter("p", 0);
  line.force->addParticleParameterOffset("p", 2, 0, 0, -1);
  Host host(line.system, GetParam());
  host->setPositions(line.positions);
  host.evaluate();
  host->setParameter("p", 1);
  EXPECT_THAT(message_of([&] { host.evaluate(); }),
              testing::HasSubstr("epsilon of particle 2 with its offsets is -0.3"));
  host->setParameter("p", 0.5);
  EXPECT_EQ(message_of([&] { host.evaluate(); }), "");
}

TEST_P(ParametersTest, UpdateParametersInContext) {
  for (const auto method : {DCHNonbondedForce::NoCutoff, DCHNonbondedForce::CutoffNonPeriodic}) {
    Case line;
    make_line(line);
    line.set_method(method, 2.5);
    Host host(line.system, GetParam());
    host->setPositions(line.positions);
    expect_near(all_pairs(*line.force, line.positions, nullptr), host.evaluate(), tolerance(), "before");
    const Evaluation before = host.evaluate();
    line.force->setParticleParameters(0, -1, 0.8, 0.9);
    line.force->setParticleParameters(3, 0.2, 0.3, 0);
    line.force->setExceptionParameters(0, 0, 1, 0, 1, 0);
    expect_near(before, host.evaluate(), 0, "not yet");
    line.force->updateParametersInContext(*host);
    expect_near(all_pairs(*line.force, line.positions, nullptr), host.evaluate(), tolerance(), "after");
  }
}

TEST_P(ParametersTest, UpdateRecomputesTheDispersionCorrection) {
  Case gas;
  for (int k = 0; k < 64; ++k) gas.add(0, 0.5, 1, Vec3(k % 4, k / 4 % 4, k / 16));
  gas.set_box(Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(0, 0, 4));
  gas.set_method(DCHNonbondedForce::CutoffPeriodic, 1.8);
  Host host(gas.system, GetParam());
  host->setPositions(gas.positions);
  host.evaluate();
  for (int k = 0; k < 64; ++k) gas.force->setParticleParameters(k, 0, 0.6, 2);
  gas.force->updateParametersInContext(*host);
  expect_near(evaluate(gas, GetParam()), host.evaluate(), tolerance());
}

TEST_P(ParametersTest, FromNonbondedCopiesEverything) {
  OpenMM::NonbondedForce own;
  own.setNonbondedMethod(OpenMM::NonbondedForce::CutoffPeriodic);
  own.setCutoffDistance(1.3);
  own.setUseSwitchingFunction(true);
  own.setSwitchingDistance(1.1);
  own.setReactionFieldDielectric(20);
  own.setUseDispersionCorrection(false);
  own.setExceptionsUsePeriodicBoundaryConditions(true);
  own.setForceGroup(4);
  own.setName("water");
  own.addParticle(0.1, 0.2, 0.3);
  own.addParticle(0.4, 0.5, 0.6);
  own.addException(0, 1, 0.7, 0.8, 0.9);
  own.addGlobalParameter("lambda", 0.25);
  own.addParticleParameterOffset("lambda", 1, 1, 2, 3);
  own.addExceptionParameterOffset("lambda", 0, 4, 5, 6);
  const std::unique_ptr<DCHNonbondedForce> copy(DCHNonbondedForce::fromNonbonded(own));
  EXPECT_EQ(OpenMM::XmlSerializer::clone(own)->getNumParticles(), copy->getNumParticles());
  std::ostringstream of_own, of_copy;
  OpenMM::XmlSerializer::serialize(&own, "Force", of_own);
  OpenMM::XmlSerializer::serialize(&copy->getParameters(), "Force", of_copy);
  const auto without_group = [](std::string text) {
    const auto at = text.find("forceGroup=\"");
    return text.erase(at, text.find('"', at + 12) - at);
  };
  EXPECT_EQ(without_group(of_own.str()), without_group(of_copy.str()));
  EXPECT_EQ(copy->getForceGroup(), 4);
  EXPECT_EQ(copy->getName(), "water");
  EXPECT_EQ(std::unique_ptr<DCHNonbondedForce>(DCHNonbondedForce::fromNonbonded(OpenMM::NonbondedForce()))
                ->getName(),
            "DCHNonbondedForce");
}

}  // namespace
}  // namespace OpenMMDCH
