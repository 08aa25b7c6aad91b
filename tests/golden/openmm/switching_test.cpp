// SPDX-License-Identifier: MIT
#include "all_pairs_oracle.hpp"

namespace OpenMMDCH {
namespace {

class SwitchingTest : public OnPlatform {};
DCH_IN_EACH_WAY(SwitchingTest);

// Energies by the formula; forces as their slope.
TEST_P(SwitchingTest, ScalesTheEnergyAndItsSlope) {
  for (const auto method : {DCHNonbondedForce::CutoffNonPeriodic, DCHNonbondedForce::CutoffPeriodic}) {
    Case pair;
    pair.add(0, 1.2, 1, Vec3());
    pair.add(0, 1.4, 2, Vec3());
    pair.set_box(Vec3(6, 0, 0), Vec3(0, 6, 0), Vec3(0, 0, 6));
    pair.set_method(method, 2);
    pair.force->setUseDispersionCorrection(false);
    pair.force->setUseSwitchingFunction(true);
    pair.force->setSwitchingDistance(1.5);
    Host host(pair.system, GetParam());
    const auto at = [&](double r) { return host.evaluate({Vec3(0, 0, 0), Vec3(r, 0, 0)}); };
    for (double r = 1.0; r < 2.5; r += 0.1) {
      const double t = std::min(std::max((r - 1.5) / 0.5, 0.0), 1.0);
      const double switched = 1 + t * t * t * (-10 + t * (15 - t * 6));
      const Evaluation found = at(r);
      const std::string what = "r = " + std::to_string(r);
      expect_near(switched * lennard_jones(1.3, std::sqrt(2.0), r).energy, found.energy, tolerance(), what);
      const double step = 1e-3;
      expect_near(-(at(r + step).energy - at(r - step).energy) / (2 * step), found.forces[1][0], 1e-3, what);
    }
  }
}

TEST_P(SwitchingTest, EqualsAllPairsWithChargesAndManyKinds) {
  for (const int kinds : {1, 3, 9}) {
    Case gas;
    dch::scenes::Random random(static_cast<std::uint64_t>(kinds));
    for (int k = 0; k < 300; ++k) {
      const int kind = k % kinds;
      const Vec3 at(0.5 * (k % 7) + 0.1 * random.uniform(), 0.5 * (k / 7 % 7) + 0.1 * random.uniform(),
                    0.5 * (k / 49) + 0.1 * random.uniform());
      gas.add(random.uniform(-0.5, 0.5), 0.3 + 0.02 * kind, 0.5 + 0.1 * kind, at);
    }
    const Vec3 box[3] = {Vec3(3.5, 0, 0), Vec3(1.0, 3.5, 0), Vec3(-1.0, 0.5, 3.5)};
    gas.set_box(box[0], box[1], box[2]);
    gas.set_method(DCHNonbondedForce::CutoffPeriodic, 1.2);
    gas.force->setUseDispersionCorrection(false);
    gas.force->setUseSwitchingFunction(true);
    gas.force->setSwitchingDistance(0.9);
    const Evaluation expected = all_pairs(*gas.force, gas.positions, box);
    const Evaluation found = evaluate(gas, GetParam());
    const std::string what = std::to_string(kinds) + " kinds";
    expect_near(expected.energy, found.energy, tolerance(), what);
    EXPECT_LT(force_error(expected, found), tolerance()) << what;
  }
}

}  // namespace
}  // namespace OpenMMDCH
