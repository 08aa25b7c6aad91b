// SPDX-License-Identifier: MIT
#include <openmm/serialization/SerializationNode.h>
#include <sstream>

#include "openmm_case.hpp"

namespace OpenMMDCH {
namespace {

std::unique_ptr<DCHNonbondedForce> make_force() {
  auto force = std::make_unique<DCHNonbondedForce>();
  force->setForceGroup(3);
  force->setName("custom name");
  force->setNonbondedMethod(DCHNonbondedForce::CutoffPeriodic);
  force->setCutoffDistance(2.25);
  force->setUseSwitchingFunction(true);
  force->setSwitchingDistance(1.125);
  force->setReactionFieldDielectric(50.5);
  force->setUseDispersionCorrection(false);
  force->setExceptionsUsePeriodicBoundaryConditions(true);
  force->addParticle(1, 0.1, 0.01);
  force->addParticle(0.5, 1.0 / 3, 0.02);
  force->addParticle(-0.5, 0.3, 0.03);
  force->addException(0, 1, 2, 0.5, 0.1);
  force->addException(1, 2, 0.2, 0.4, 0.2);
  force->addGlobalParameter("scale1", 1);
  force->addGlobalParameter("scale2", 2);
  force->addParticleParameterOffset("scale1", 2, 1.5, 2, 2.5);
  force->addExceptionParameterOffset("scale2", 1, -0.1, -0.2, -0.3);
  return force;
}

std::string text_of(const DCHNonbondedForce& force) {
  std::ostringstream text;
  OpenMM::XmlSerializer::serialize(&force, "Force", text);
  return text.str();
}

std::unique_ptr<DCHNonbondedForce> read(const std::string& text) {
  std::istringstream in(text);
  return std::unique_ptr<DCHNonbondedForce>(OpenMM::XmlSerializer::deserialize<DCHNonbondedForce>(in));
}

TEST(SerializationTest, ReadsWhatItWrites) {
  const auto force = make_force();
  const auto copy = read(text_of(*force));
  EXPECT_EQ(copy->getForceGroup(), 3);
  EXPECT_EQ(copy->getName(), "custom name");
  EXPECT_EQ(copy->getNonbondedMethod(), DCHNonbondedForce::CutoffPeriodic);
  EXPECT_EQ(copy->getCutoffDistance(), 2.25);
  EXPECT_TRUE(copy->getUseSwitchingFunction());
  EXPECT_EQ(copy->getSwitchingDistance(), 1.125);
  EXPECT_EQ(copy->getReactionFieldDielectric(), 50.5);
  EXPECT_FALSE(copy->getUseDispersionCorrection());
  EXPECT_TRUE(copy->getExceptionsUsePeriodicBoundaryConditions());
  ASSERT_EQ(copy->getNumParticles(), 3);
  double q, sigma, epsilon;
  copy->getParticleParameters(1, q, sigma, epsilon);
  EXPECT_EQ(sigma, 1.0 / 3);
  ASSERT_EQ(copy->getNumExceptions(), 2);
  int i, j;
  copy->getExceptionParameters(1, i, j, q, sigma, epsilon);
  EXPECT_EQ((std::vector<double>{1.0 * i, 1.0 * j, q, sigma, epsilon}),
            (std::vector<double>{1, 2, 0.2, 0.4, 0.2}));
  ASSERT_EQ(copy->getNumGlobalParameters(), 2);
  EXPECT_EQ(copy->getGlobalParameterName(1), "scale2");
  EXPECT_EQ(copy->getGlobalParameterDefaultValue(1), 2);
  std::string parameter;
  copy->getParticleParameterOffset(0, parameter, i, q, sigma, epsilon);
  EXPECT_EQ(parameter, "scale1");
  EXPECT_EQ((std::vector<double>{1.0 * i, q, sigma, epsilon}), (std::vector<double>{2, 1.5, 2, 2.5}));
  copy->getExceptionParameterOffset(0, parameter, i, q, sigma, epsilon);
  EXPECT_EQ(parameter, "scale2");
  EXPECT_EQ((std::vector<double>{1.0 * i, q, sigma, epsilon}), (std::vector<double>{1, -0.1, -0.2, -0.3}));
  EXPECT_EQ(text_of(*copy), text_of(*force));
}

TEST(SerializationTest, WritesAVersionAndRefusesOthers) {
  std::string text = text_of(*make_force());
  const auto at = text.find("version=\"1\"");
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, 11, "version=\"2\"");
  EXPECT_THAT(message_of([&] { read(text); }), testing::HasSubstr("serialized version 2 is unknown"));
}

TEST(SerializationTest, MethodsThatItDoesNotHaveAreRefused) {
  std::string text = text_of(*make_force());
  const auto at = text.find("method=\"2\"");
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, 10, "method=\"4\"");
  EXPECT_THAT(message_of([&] { read(text); }), testing::HasSubstr("4 is no nonbonded method"));
}

TEST(SerializationTest, PartOfASystem) {
  Case of_system;
  of_system.add(0.5, 0.3, 1, Vec3(0, 0, 0));
  of_system.add(-0.5, 0.3, 1, Vec3(0.4, 0, 0));
  std::stringstream text;
  OpenMM::XmlSerializer::serialize(&of_system.system, "System", text);
  const std::unique_ptr<OpenMM::System> copy(OpenMM::XmlSerializer::deserialize<OpenMM::System>(text));
  ASSERT_EQ(copy->getNumForces(), 1);
  ASSERT_NE(dynamic_cast<DCHNonbondedForce*>(&copy->getForce(0)), nullptr);
  dch_platforms();
  expect_near(evaluate(of_system, "Reference"), Host(*copy, "Reference").evaluate(of_system.positions), 0);
}

}  // namespace
}  // namespace OpenMMDCH
