// SPDX-License-Identifier: MIT
//
// Every complaint about a NecklaceContactForce names the offending value.
#include <limits>

#include "contact_case.hpp"

namespace OpenMMDCH {
namespace {

using testing::HasSubstr;

class ContactErrorsTest : public OnPlatform {
 protected:
  ContactErrorsTest() {
    for (int i = 0; i < 6; ++i) two.add_particle(Vec3(i, 0, 0));
    two.force->addChain({0, 1, 2}, {0.1, 0.2, 0.3});
    two.force->addChain({5, 4}, {0.1, 0.2});
  }
  /// What making a Context says.
  std::string complaint() {
    return message_of([&] { Host(two.system, GetParam()); });
  }
  NecklaceContactForce& force() { return *two.force; }
  ContactCase two;
};
DCH_ON_EACH_PLATFORM(ContactErrorsTest);

TEST_P(ContactErrorsTest, Particles) {
  EXPECT_EQ(complaint(), "");
  force().setChainParameters(1, {5, 6}, {0.1, 0.2});
  EXPECT_THAT(complaint(), HasSubstr("chain 1 names particle 6; the System has 6"));
  force().setChainParameters(1, {-1, 5}, {0.1, 0.2});
  EXPECT_THAT(complaint(), HasSubstr("chain 1 names particle -1"));
  force().setChainParameters(1, {5, 2}, {0.1, 0.2});
  EXPECT_THAT(complaint(), HasSubstr("chains 0 and 1 share particle 2"));
  force().setChainParameters(1, {5, 4, 5}, {0.1, 0.2, 0.1});
  EXPECT_THAT(complaint(), HasSubstr("chain 1 names particle 5 twice"));
  force().setChainParameters(1, {5, 4}, {0.1, 0.2}, true);
  EXPECT_THAT(complaint(), HasSubstr("chain 1 is closed and has 2 beads"));
  force().setChainParameters(1, {}, {});
  EXPECT_THAT(complaint(), HasSubstr("chain 1 has 0 beads"));
  force().setChainParameters(1, {3}, {0.5});
  EXPECT_EQ(complaint(), "");
}

TEST_P(ContactErrorsTest, Radii) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::pair<double, const char*> bad[] = {{0, "0"}, {-0.25, "-0.25"}, {infinity, "inf"}, {NAN, "nan"}};
  for (const auto& [radius, text] : bad) {
    force().setChainParameters(0, {0, 1, 2}, {0.1, radius, 0.3});
    EXPECT_THAT(complaint(), HasSubstr("the radius of particle 1 in chain 0 is "));
    EXPECT_THAT(complaint(), HasSubstr(std::string(text) + " nm; it must be finite and positive"));
  }
}

TEST_P(ContactErrorsTest, Settings) {
  force().setStrength(-2);
  EXPECT_THAT(complaint(), HasSubstr("the strength is -2;"));
  force().setStrength(std::numeric_limits<double>::infinity());
  EXPECT_THAT(complaint(), HasSubstr("the strength is inf;"));
  force().setStrength(0);
  force().setExcludedBonds(-1);
  EXPECT_THAT(complaint(), HasSubstr("the number of excluded bonds is -1;"));
  force().setExcludedBonds(1000000000);
  EXPECT_EQ(complaint(), "");
}

TEST_P(ContactErrorsTest, BoxesTooSmallForTheRadii) {
  force().setUsesPeriodicBoundaryConditions(true);
  two.system.setDefaultPeriodicBoxVectors(Vec3(5, 0, 0), Vec3(0, 1.19, 0), Vec3(0, 0, 5));
  EXPECT_THAT(complaint(), testing::AllOf(HasSubstr("twice the largest radius is 0.6 nm"),
                                          HasSubstr("smallest height of the periodic box, 0.595 nm")));
  two.system.setDefaultPeriodicBoxVectors(Vec3(5, 0, 0), Vec3(0, 1.21, 0), Vec3(0, 0, 5));
  EXPECT_EQ(complaint(), "");
}

TEST_P(ContactErrorsTest, UpdatesThatDoNotFitTheContext) {
  Host host(two.system, GetParam());
  const auto update = [&] { return message_of([&] { force().updateParametersInContext(*host); }); };
  EXPECT_EQ(update(), "");
  force().setChainParameters(1, {4, 5}, {0.1, 0.2});
  EXPECT_THAT(update(), HasSubstr("chain 1 has other particles than before"));
  force().setChainParameters(1, {5, 4}, {0.1, 0.2});
  force().setChainParameters(0, {0, 1, 2}, {0.1, 0.2, 0.3}, true);
  EXPECT_THAT(update(), HasSubstr("chain 0 has other particles than before, or has been opened or closed"));
  force().setChainParameters(0, {0, 1, 2}, {0.1, -0.2, 0.3});
  EXPECT_THAT(update(), HasSubstr("the radius of particle 1 in chain 0 is -0.2 nm"));
  force().setChainParameters(0, {0, 1, 2}, {0.1, 0.2, 0.3});
  force().setStrength(NAN);
  EXPECT_THAT(update(), HasSubstr("the strength is nan"));
  force().setStrength(1);
  force().addChain({3}, {1});
  EXPECT_THAT(update(), HasSubstr("the number of chains has changed from 2 to 3"));
}

TEST(ContactIndicesTest, IndicesAndLengths) {
  NecklaceContactForce force;
  std::vector<int> particles;
  std::vector<double> radii;
  bool closed;
  EXPECT_THAT(message_of([&] {
                force.addChain({0, 1}, {0.1});
              }),
              HasSubstr("a chain of 2 particles has 1 radii"));
  EXPECT_EQ(force.getNumChains(), 0);
  EXPECT_EQ(force.addChain({0, 1}, {0.1, 0.1}), 0);
  EXPECT_THAT(message_of([&] {
                force.setChainParameters(0, {0}, {0.1, 0.2});
              }),
              HasSubstr("a chain of 1 particles has 2 radii"));
  EXPECT_THAT(message_of([&] { force.setChainParameters(1, {0}, {0.1}); }),
              HasSubstr("no chain 1; it has 1"));
  EXPECT_THAT(message_of([&] { force.getChainParameters(-1, particles, radii, closed); }),
              HasSubstr("no chain -1"));
  EXPECT_THAT(
      message_of([&] { force.setEnergyFunction(static_cast<NecklaceContactForce::EnergyFunction>(3)); }),
      HasSubstr("3 is no energy function; choose WCA (0), Harmonic (1) or SoftCosine (2)"));
}

}  // namespace
}  // namespace OpenMMDCH
