// SPDX-License-Identifier: MIT
#include <openmm/serialization/SerializationNode.h>
#include <sstream>

#include "contact_case.hpp"

namespace OpenMMDCH {
namespace {

std::unique_ptr<NecklaceContactForce> make_force() {
  auto force = std::make_unique<NecklaceContactForce>();
  force->setForceGroup(3);
  force->setName("custom name");
  force->setEnergyFunction(NecklaceContactForce::SoftCosine);
  force->setStrength(2.0 / 3);
  force->setExcludedBonds(4);
  force->setActsWithinChains(false);
  force->setActsBetweenChains(false);
  force->setUsesPeriodicBoundaryConditions(true);
  force->addChain({2, 0, 1}, {0.1, 1.0 / 3, 0.3}, true);
  force->addChain({4}, {0.5});
  return force;
}

std::string text_of(const NecklaceContactForce& force) {
  std::ostringstream text;
  OpenMM::XmlSerializer::serialize(&force, "Force", text);
  return text.str();
}

std::unique_ptr<NecklaceContactForce> read(const std::string& text) {
  std::istringstream in(text);
  return std::unique_ptr<NecklaceContactForce>(OpenMM::XmlSerializer::deserialize<NecklaceContactForce>(in));
}

/// The text with one attribute replaced.
std::string with(std::string text, const std::string& before, const std::string& after) {
  const auto at = text.find(before);
  EXPECT_NE(at, std::string::npos) << text;
  return at == std::string::npos ? text : text.replace(at, before.size(), after);
}

TEST(ContactSerializationTest, ReadsWhatItWrites) {
  const auto force = make_force();
  const auto copy = read(text_of(*force));
  EXPECT_EQ(copy->getForceGroup(), 3);
  EXPECT_EQ(copy->getName(), "custom name");
  EXPECT_EQ(copy->getEnergyFunction(), NecklaceContactForce::SoftCosine);
  EXPECT_EQ(copy->getStrength(), 2.0 / 3);
  EXPECT_EQ(copy->getExcludedBonds(), 4);
  EXPECT_FALSE(copy->getActsWithinChains());
  EXPECT_FALSE(copy->getActsBetweenChains());
  EXPECT_TRUE(copy->usesPeriodicBoundaryConditions());
  ASSERT_EQ(copy->getNumChains(), 2);
  std::vector<int> particles;
  std::vector<double> radii;
  bool closed;
  copy->getChainParameters(0, particles, radii, closed);
  EXPECT_EQ(particles, (std::vector<int>{2, 0, 1}));
  EXPECT_EQ(radii, (std::vector<double>{0.1, 1.0 / 3, 0.3}));
  EXPECT_TRUE(closed);
  copy->getChainParameters(1, particles, radii, closed);
  EXPECT_EQ(particles, std::vector<int>{4});
  EXPECT_FALSE(closed);
  EXPECT_EQ(text_of(*copy), text_of(*force));
  EXPECT_EQ(read(text_of(NecklaceContactForce()))->getName(), "NecklaceContactForce");
}

TEST(ContactSerializationTest, WhatItDoesNotKnowIsRefused) {
  const std::string text = text_of(*make_force());
  EXPECT_THAT(message_of([&] { read(with(text, "version=\"1\"", "version=\"2\"")); }),
              testing::HasSubstr("serialized version 2 is unknown"));
  EXPECT_THAT(message_of([&] { read(with(text, "energyFunction=\"2\"", "energyFunction=\"3\"")); }),
              testing::HasSubstr("3 is no energy function"));
}

TEST(ContactSerializationTest, PartOfASystem) {
  const Vec3 box[3] = {Vec3(2.2, 0, 0), Vec3(0, 2.2, 0), Vec3(0, 0, 2.2)};
  ContactCase tangle;
  make_tangle(tangle, box, 91);
  std::stringstream text;
  OpenMM::XmlSerializer::serialize(&tangle.system, "System", text);
  const std::unique_ptr<OpenMM::System> copy(OpenMM::XmlSerializer::deserialize<OpenMM::System>(text));
  ASSERT_NE(dynamic_cast<NecklaceContactForce*>(&copy->getForce(0)), nullptr);
  EXPECT_TRUE(copy->usesPeriodicBoundaryConditions());
  dch_platforms();
  expect_near(evaluate(tangle, "Reference"), Host(*copy, "Reference").evaluate(tangle.positions), 0);
}

}  // namespace
}  // namespace OpenMMDCH
