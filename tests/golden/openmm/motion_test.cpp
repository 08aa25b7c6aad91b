// SPDX-License-Identifier: MIT
//
// Lists that are kept up while particles move and boxes change.
#include "all_pairs_oracle.hpp"

namespace OpenMMDCH {
namespace {

class MotionTest : public OnPlatform {};
DCH_ON_EACH_PLATFORM(MotionTest);

/// A liquid of N charged particles of two kinds on a jittered lattice in a box.
void make_liquid(Case& liquid, int per_side, const Vec3* box, std::uint64_t seed) {
  dch::scenes::Random random(seed);
  for (int k = 0; k < per_side * per_side * per_side; ++k) {
    const double x = (k % per_side + 0.2 * random.uniform()) / per_side;
    const double y = (k / per_side % per_side + 0.2 * random.uniform()) / per_side;
    const double z = (k / per_side / per_side + 0.2 * random.uniform()) / per_side;
    liquid.add(k % 2 == 0 ? 0.3 : -0.3, 0.3, k % 3 == 0 ? 0.8 : 0.5, box[0] * x + box[1] * y + box[2] * z);
  }
  liquid.set_box(box[0], box[1], box[2]);
  liquid.set_method(DCHNonbondedForce::CutoffPeriodic, 0.9);
  // Forces are small at the cutoff itself, where single precision may take a pair or not, and large just
  // below.
  liquid.force->setReactionFieldDielectric(1e6);
  liquid.force->setUseDispersionCorrection(false);
}

TEST_P(MotionTest, FollowsParticlesStepByStep) {
  const Vec3 box[3] = {Vec3(2.6, 0, 0), Vec3(0.8, 2.6, 0), Vec3(-0.9, 1.1, 2.6)};
  Case liquid;
  make_liquid(liquid, 7, box, 11);
  Host host(liquid.system, GetParam());
  dch::scenes::Random random(12);
  // Slow enough that no two come so near that the digits of single precision decide over all forces.
  std::vector<Vec3> velocities(liquid.positions.size());
  for (Vec3& v : velocities) v = random.vector<Vec3>(-1, 1) * 0.004;
  std::vector<Vec3> positions = liquid.positions;
  for (int step = 0; step < 40; ++step) {
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += velocities[i];
    const Evaluation found = host.evaluate(positions);
    const Evaluation expected = all_pairs(*liquid.force, positions, box);
    ASSERT_LT(force_error(expected, found), tolerance()) << "step " << step;
    expect_near(expected.energy, found.energy, tolerance(), "step " + std::to_string(step));
  }
}

TEST_P(MotionTest, FollowsABoxThatChangesEveryStep) {
  const Vec3 box[3] = {Vec3(2.6, 0, 0), Vec3(0.3, 2.6, 0), Vec3(-0.4, 0.5, 2.6)};
  Case liquid;
  make_liquid(liquid, 7, box, 21);
  Host host(liquid.system, GetParam());
  for (int step = 0; step < 40; ++step) {
    // Shrinks until hardly anything is left for a skin, then grows; sheared all along.
    const double scale = 1 - 0.015 * (step < 20 ? step : 40 - step), shear = 0.02 * step;
    const Vec3 now[3] = {box[0] * scale, Vec3(box[1][0] + shear, box[1][1], 0) * scale, box[2] * scale};
    std::vector<Vec3> positions = liquid.positions;
    for (Vec3& p : positions) {
      const double z = p[2] / box[2][2], y = (p[1] - z * box[2][1]) / box[1][1];
      const double x = (p[0] - z * box[2][0] - y * box[1][0]) / box[0][0];
      p = now[0] * x + now[1] * y + now[2] * z;
    }
    host->setPeriodicBoxVectors(now[0], now[1], now[2]);
    const Evaluation found = host.evaluate(positions), expected = all_pairs(*liquid.force, positions, now);
    ASSERT_LT(force_error(expected, found), tolerance()) << "step " << step;
    expect_near(expected.energy, found.energy, tolerance(), "step " + std::to_string(step));
  }
}

TEST_P(MotionTest, FollowsJumpsAndTeleports) {
  const Vec3 box[3] = {Vec3(2.6, 0, 0), Vec3(0, 2.6, 0), Vec3(0, 0, 2.6)};
  Case liquid;
  make_liquid(liquid, 6, box, 31);
  Host host(liquid.system, GetParam());
  host.evaluate(liquid.positions);
  dch::scenes::Random random(32);
  for (int step = 0; step < 10; ++step) {
    std::vector<Vec3> positions = liquid.positions;
    random.shuffle(positions);
    for (Vec3& p : positions)
      p += box[0] * static_cast<double>(random.below(9)) - box[1] * static_cast<double>(random.below(9));
    ASSERT_LT(force_error(all_pairs(*liquid.force, positions, box), host.evaluate(positions)), tolerance())
        << "step " << step;
  }
}

TEST_P(MotionTest, ABoxThatHasBecomeTooSmallIsRefused) {
  const Vec3 box[3] = {Vec3(2.6, 0, 0), Vec3(0, 2.6, 0), Vec3(0, 0, 2.6)};
  Case liquid;
  make_liquid(liquid, 5, box, 41);
  Host host(liquid.system, GetParam());
  host.evaluate(liquid.positions);
  host->setPeriodicBoxVectors(box[0], Vec3(0, 1.7, 0), box[2]);
  EXPECT_THAT(message_of([&] { host.evaluate(liquid.positions); }),
              testing::AllOf(testing::HasSubstr("0.9 nm"), testing::HasSubstr("1.7 nm wide along y")));
  host->setPeriodicBoxVectors(box[0], box[1], box[2]);
  EXPECT_LT(force_error(all_pairs(*liquid.force, liquid.positions, box), host.evaluate(liquid.positions)),
            tolerance());
}

// The energy of a small liquid stays where it is: forces are the slope of the energy at every list.
TEST_P(MotionTest, EnergyIsConserved) {
  const Vec3 box[3] = {Vec3(2.8, 0, 0), Vec3(0, 2.8, 0), Vec3(0, 0, 2.8)};
  Case liquid;
  make_liquid(liquid, 7, box, 51);
  liquid.force->setUseSwitchingFunction(true);
  liquid.force->setSwitchingDistance(0.7);
  for (int i = 0; i < 343; ++i) {
    double q, sigma, epsilon;
    liquid.force->getParticleParameters(i, q, sigma, epsilon);
    liquid.force->setParticleParameters(i, 0, sigma, epsilon);
    liquid.system.setParticleMass(i, 40);
  }
  OpenMM::VerletIntegrator integrator(0.002);
  OpenMM::Context context(liquid.system, integrator, OpenMM::Platform::getPlatformByName(GetParam()));
  context.setPositions(liquid.positions);
  context.setVelocitiesToTemperature(100, 5);
  const auto energy = [&] {
    const OpenMM::State state = context.getState(OpenMM::State::Energy);
    return state.getPotentialEnergy() + state.getKineticEnergy();
  };
  integrator.step(50);
  const double before = energy(), kinetic = context.getState(OpenMM::State::Energy).getKineticEnergy();
  integrator.step(300);
  EXPECT_NEAR(energy(), before, 0.005 * kinetic);
}

}  // namespace
}  // namespace OpenMMDCH
