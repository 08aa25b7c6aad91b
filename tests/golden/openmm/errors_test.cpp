// SPDX-License-Identifier: MIT
//
// Every complaint names the offending value.
#include <limits>

#include "openmm_case.hpp"

namespace OpenMMDCH {
namespace {

using testing::HasSubstr;

class ErrorsTest : public OnPlatform {
 protected:
  ErrorsTest() {
    for (int i = 0; i < 4; ++i) pair.add(0.1, 0.3, 0.5, Vec3(i, 0, 0));
    pair.set_box(Vec3(5, 0, 0), Vec3(0, 4, 0), Vec3(0, 0, 5));
  }
  /// What making a Context says.
  std::string complaint() {
    return message_of([&] { Host(pair.system, GetParam()); });
  }
  Case pair;
};
DCH_ON_EACH_PLATFORM(ErrorsTest);

TEST_P(ErrorsTest, Particles) {
  EXPECT_EQ(complaint(), "");
  pair.force->setParticleParameters(2, 0.1, -0.25, 0.5);
  EXPECT_THAT(complaint(), HasSubstr("sigma of particle 2 is -0.25"));
  pair.force->setParticleParameters(2, 0.1, 0.25, -0.75);
  EXPECT_THAT(complaint(), HasSubstr("epsilon of particle 2 is -0.75"));
  pair.force->setParticleParameters(2, std::numeric_limits<double>::quiet_NaN(), 0.25, 0.75);
  EXPECT_THAT(complaint(), HasSubstr("charge of particle 2 is nan"));
  pair.force->setParticleParameters(2, 0, 0.25, 0.75);
  pair.force->addParticle(0, 1, 1);
  EXPECT_THAT(complaint(), testing::AllOf(HasSubstr("5 particles"), HasSubstr("the System has 4")));
}

TEST_P(ErrorsTest, Cutoffs) {
  for (const auto method : {DCHNonbondedForce::CutoffNonPeriodic, DCHNonbondedForce::CutoffPeriodic}) {
    pair.set_method(method, 0);
    EXPECT_THAT(complaint(), HasSubstr("cutoff distance is 0 nm"));
    pair.set_method(method, -1);
    EXPECT_THAT(complaint(), HasSubstr("cutoff distance is -1 nm"));
    pair.set_method(method, 1.5);
    pair.force->setUseSwitchingFunction(true);
    pair.force->setSwitchingDistance(1.5);
    EXPECT_THAT(complaint(), HasSubstr("switching distance is 1.5 nm"));
    pair.force->setSwitchingDistance(-0.5);
    EXPECT_THAT(complaint(), HasSubstr("switching distance is -0.5 nm"));
    pair.force->setUseSwitchingFunction(false);
    pair.force->setReactionFieldDielectric(-2);
    EXPECT_THAT(complaint(), HasSubstr("dielectric is -2"));
    pair.force->setReactionFieldDielectric(2);
    EXPECT_EQ(complaint(), "");
  }
  pair.set_method(DCHNonbondedForce::CutoffPeriodic, 2.1);
  EXPECT_THAT(complaint(), testing::AllOf(HasSubstr("2.1 nm"), HasSubstr("4 nm wide along y")));
  pair.set_method(DCHNonbondedForce::CutoffPeriodic, 2);
  EXPECT_EQ(complaint(), "");
}

TEST_P(ErrorsTest, Exceptions) {
  pair.force->addException(0, 1, 0, 1, 0);
  EXPECT_THAT(message_of([&] { pair.force->addException(1, 0, 0, 1, 0); }), HasSubstr("0"));
  EXPECT_EQ(pair.force->addException(1, 0, 0.5, 1, 0, true), 0);
  EXPECT_EQ(pair.force->addException(1, 2, 0, 1, 0), 1);
  pair.force->setExceptionParameters(1, 0, 1, 0, 1, 0);
  EXPECT_THAT(complaint(), HasSubstr("exception 1 is a second one for particles 0 and 1"));
  pair.force->setExceptionParameters(1, 1, 4, 0, 1, 0);
  EXPECT_THAT(complaint(), HasSubstr("exception 1 names particle 4; there are 4"));
  pair.force->setExceptionParameters(1, -1, 1, 0, 1, 0);
  EXPECT_THAT(complaint(), HasSubstr("exception 1 names particle -1"));
  pair.force->setExceptionParameters(1, 2, 2, 0, 1, 0);
  EXPECT_THAT(complaint(), HasSubstr("exception 1 names particle 2 twice"));
  pair.force->setExceptionParameters(1, 1, 2, 0, -3, 0);
  EXPECT_THAT(complaint(), HasSubstr("sigma of exception 1 is -3"));
  pair.force->setExceptionParameters(1, 1, 2, 0, 3, -4);
  EXPECT_THAT(complaint(), HasSubstr("epsilon of exception 1 is -4"));
  EXPECT_THAT(message_of([&] {
                pair.force->createExceptionsFromBonds({{0, 9}}, 1, 1);
              }),
              HasSubstr("particle 9"));
}

TEST_P(ErrorsTest, Offsets) {
  EXPECT_NE(message_of([&] { pair.force->addParticleParameterOffset("q", 0, 1, 1, 1); }), "");
  pair.force->addGlobalParameter("q", 0);
  pair.force->addParticleParameterOffset("q", 7, 1, 1, 1);
  EXPECT_THAT(complaint(), HasSubstr("particle parameter offset 0 names particle 7; there are 4"));
  pair.force->setParticleParameterOffset(0, "q", 0, 1, 1, 1);
  pair.force->addExceptionParameterOffset("q", 0, 1, 1, 1);
  EXPECT_THAT(complaint(), HasSubstr("exception parameter offset 0 names exception 0; there are 0"));
}

TEST_P(ErrorsTest, Indices) {
  double q, sigma, epsilon;
  int i, j;
  std::string name;
  DCHNonbondedForce& force = *pair.force;
  EXPECT_THAT(message_of([&] { force.getParticleParameters(4, q, sigma, epsilon); }),
              HasSubstr("no particle 4"));
  EXPECT_THAT(message_of([&] { force.setParticleParameters(-1, 0, 1, 1); }), HasSubstr("no particle -1"));
  EXPECT_THAT(message_of([&] { force.getExceptionParameters(0, i, j, q, sigma, epsilon); }),
              HasSubstr("no exception 0"));
  EXPECT_THAT(message_of([&] { force.setExceptionParameters(1, 0, 1, 0, 1, 1); }),
              HasSubstr("no exception 1"));
  EXPECT_THAT(message_of([&] { force.getGlobalParameterName(2); }), HasSubstr("no global parameter 2"));
  EXPECT_THAT(message_of([&] { force.setGlobalParameterDefaultValue(3, 0); }),
              HasSubstr("no global parameter 3"));
  EXPECT_THAT(message_of([&] { force.getParticleParameterOffset(0, name, i, q, sigma, epsilon); }),
              HasSubstr("no particle parameter offset 0"));
  EXPECT_THAT(message_of([&] { force.getExceptionParameterOffset(0, name, i, q, sigma, epsilon); }),
              HasSubstr("no exception parameter offset 0"));
}

TEST_P(ErrorsTest, UpdatesThatDoNotFitTheContext) {
  pair.force->addException(0, 1, 0.5, 1, 0);
  Host host(pair.system, GetParam());
  const auto update = [&] { return message_of([&] { pair.force->updateParametersInContext(*host); }); };
  pair.force->setExceptionParameters(0, 0, 2, 0.5, 1, 0);
  EXPECT_THAT(update(), HasSubstr("exception 0 was for particles 0 and 1 and is now for 0 and 2"));
  pair.force->setExceptionParameters(0, 1, 0, 0.5, 1, 0);
  EXPECT_EQ(update(), "");
  pair.force->setParticleParameters(3, 0, -1, 0);
  EXPECT_THAT(update(), HasSubstr("sigma of particle 3 is -1"));
  pair.force->setParticleParameters(3, 0, 1, 0);
  pair.force->addException(2, 3, 0, 1, 0);
  EXPECT_THAT(update(), HasSubstr("number of exceptions has changed from 1 to 2"));
  pair.force->addParticle(0, 1, 1);
  EXPECT_THAT(update(), HasSubstr("5 particles"));
}

TEST_P(ErrorsTest, PositionsThatAreNotFinite) {
  for (const auto method : {DCHNonbondedForce::NoCutoff, DCHNonbondedForce::CutoffNonPeriodic,
                            DCHNonbondedForce::CutoffPeriodic}) {
    pair.set_method(method, 1.5);
    Host host(pair.system, GetParam());
    std::vector<Vec3> positions = pair.positions;
    positions[2][1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(message_of([&] { host.evaluate(positions); }), "") << method;
    EXPECT_EQ(message_of([&] { host.evaluate(pair.positions); }), "");
  }
}

TEST_P(ErrorsTest, DispersionCorrectionOfASwitchThatBeginsAtZero) {
  pair.set_method(DCHNonbondedForce::CutoffPeriodic, 1.5);
  pair.force->setUseSwitchingFunction(true);
  pair.force->setSwitchingDistance(0);
  EXPECT_THAT(complaint(), HasSubstr("switching distance is 0"));
  pair.force->setUseDispersionCorrection(false);
  EXPECT_EQ(complaint(), "");
}

TEST(MethodsTest, LatticeSumsAreRefused) {
  OpenMM::NonbondedForce own;
  const char* const names[] = {"Ewald", "PME", "LJPME"};
  for (int k = 0; k < 3; ++k) {
    own.setNonbondedMethod(
        static_cast<OpenMM::NonbondedForce::NonbondedMethod>(OpenMM::NonbondedForce::Ewald + k));
    EXPECT_THAT(message_of([&] { DCHNonbondedForce::fromNonbonded(own); }),
                HasSubstr(std::string("nonbonded method ") + names[k]));
    DCHNonbondedForce force;
    EXPECT_THAT(
        message_of([&] { force.setNonbondedMethod(static_cast<DCHNonbondedForce::NonbondedMethod>(3 + k)); }),
        HasSubstr(std::to_string(3 + k) + " is no nonbonded method"));
  }
  own.setNonbondedMethod(OpenMM::NonbondedForce::CutoffPeriodic);
  own.setIncludeDirectSpace(false);
  EXPECT_THAT(message_of([&] { DCHNonbondedForce::fromNonbonded(own); }), HasSubstr("direct space"));
}

}  // namespace
}  // namespace OpenMMDCH
