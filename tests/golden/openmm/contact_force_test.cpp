// SPDX-License-Identifier: MIT
//
// Energies, forces and contacts of a NecklaceContactForce against formulas and all pairs.
#include "contact_case.hpp"

namespace OpenMMDCH {
namespace {

class ContactForceTest : public OnPlatform {};
DCH_ON_EACH_PLATFORM(ContactForceTest);

void expect_same(const std::vector<NecklaceContact>& expected, const std::vector<NecklaceContact>& found) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].particle1, expected[k].particle1);
    EXPECT_EQ(found[k].particle2, expected[k].particle2);
    EXPECT_NEAR(found[k].gap, expected[k].gap, 1e-12);
  }
}

TEST_P(ContactForceTest, TwoBeads) {
  for (const double r : {0.1, 0.25, 0.4, 0.49, 0.5, 0.6}) {
    ContactCase pair;
    pair.add_chain({Vec3(0, 0, 0)}, 0.2);
    pair.add_chain({Vec3(0, 0, r)}, 0.3);
    pair.force->setStrength(3);
    // q^6 of the definitions in the header, with d = 0.5.
    const double q6 = std::pow(0.5 / r, 6);
    const double energies[] = {3 * (q6 * q6 - 2 * q6 + 1), 1.5 * (0.5 - r) * (0.5 - r),
                               3 * (1 + std::cos(M_PI * r / 0.5))};
    const double forces[] = {36 * (q6 * q6 - q6) / r, 3 * (0.5 - r),
                             3 * M_PI / 0.5 * std::sin(M_PI * r / 0.5)};
    for (const auto function : kEnergyFunctions) {
      pair.force->setEnergyFunction(function);
      const double energy = r < 0.5 ? energies[function] : 0, force = r < 0.5 ? forces[function] : 0;
      expect_near({energy, {Vec3(0, 0, -force), Vec3(0, 0, force)}}, evaluate(pair, GetParam()),
                  kContactTolerance, "function " + std::to_string(function) + ", r = " + std::to_string(r));
    }
  }
}

TEST_P(ContactForceTest, EqualsAllPairs) {
  const Vec3 cube[3] = {Vec3(2.2, 0, 0), Vec3(0, 2.2, 0), Vec3(0, 0, 2.2)};
  const Vec3 skewed[3] = {Vec3(2.4, 0, 0), Vec3(1.1, 2.1, 0), Vec3(-1.2, 1, 2.2)};
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Vec3* const box = seed % 3 == 0 ? nullptr : seed % 3 == 1 ? cube : skewed;
    ContactCase tangle;
    make_tangle(tangle, box, seed);
    NecklaceContactForce& force = *tangle.force;
    force.setStrength(0.5 + 0.25 * static_cast<double>(seed));
    force.setExcludedBonds(static_cast<int>(seed % 4));
    force.setActsWithinChains(seed % 5 != 0);
    force.setActsBetweenChains(seed % 7 != 0);
    for (const auto function : kEnergyFunctions) {
      force.setEnergyFunction(function);
      const std::string what = "seed " + std::to_string(seed) + ", function " + std::to_string(function);
      const Evaluation expected = all_contacts(force, tangle.positions, box);
      ASSERT_GT(expected.energy, 0) << what;
      expect_near(expected, evaluate(tangle, GetParam()), kContactTolerance, what);
    }
    Host host(tangle.system, GetParam());
    host->setPositions(tangle.positions);
    for (const double gap : {0.0, 0.1, -0.05}) {
      const auto contacts = contact_oracle(force, tangle.positions, box, gap);
      ASSERT_FALSE(contacts.empty()) << "seed " << seed << ", gap " << gap;
      expect_same(contacts, force.getContacts(*host, gap));
    }
  }
}

TEST_P(ContactForceTest, IsTheSlopeOfTheEnergy) {
  const Vec3 box[3] = {Vec3(2.2, 0, 0), Vec3(0.4, 2.2, 0), Vec3(0.5, -0.6, 2.2)};
  ContactCase tangle;
  make_tangle(tangle, box, 21);
  constexpr double kStep = 1e-5;
  for (const auto function : kEnergyFunctions) {
    tangle.force->setEnergyFunction(function);
    Host host(tangle.system, GetParam());
    const Evaluation found = host.evaluate(tangle.positions);
    std::vector<Vec3> moved = tangle.positions;
    for (std::size_t i = 0; i < moved.size(); i += 3)
      for (int axis = 0; axis < 3; ++axis) {
        const double at = moved[i][axis];
        moved[i][axis] = at + kStep;
        const double ahead = host.evaluate(moved).energy;
        moved[i][axis] = at - kStep;
        const double slope = (ahead - host.evaluate(moved).energy) / (2 * kStep);
        moved[i][axis] = at;
        // The last term is the rounding of the energy over the step.
        EXPECT_NEAR(found.forces[i][axis], -slope,
                    1e-5 * std::max(1.0, std::abs(slope)) + 1e-15 / kStep * found.energy)
            << "function " << function << ", particle " << i << ", axis " << axis;
      }
  }
}

TEST_P(ContactForceTest, ExcludedBondsGoAroundRings) {
  for (const bool closed : {false, true}) {
    ContactCase ring;
    ring.add_chain(circle(6, 0.2, Vec3(0, 0, 0)), 0.3, closed);  // all touch all
    for (int bonds = 0; bonds <= 6; ++bonds) {
      ring.force->setExcludedBonds(bonds);
      Host host(ring.system, GetParam());
      host->setPositions(ring.positions);
      // Of six beads in a row 6 - k pairs are k bonds apart; around a ring 6, 6 and 3 for k = 1, 2, 3.
      const std::size_t row[] = {15, 10, 6, 3, 1, 0, 0}, around[] = {15, 9, 3, 0, 0, 0, 0};
      EXPECT_EQ(ring.force->getContacts(*host).size(), (closed ? around : row)[bonds]) << closed << bonds;
      expect_near(all_contacts(*ring.force, ring.positions, nullptr), host.evaluate(), kContactTolerance);
    }
  }
}

TEST_P(ContactForceTest, NothingToTouch) {
  ContactCase none;
  none.add_particle(Vec3(0, 0, 0));
  none.add_particle(Vec3(0, 0, 0));
  EXPECT_EQ(evaluate(none, GetParam()).energy, 0);
  none.force->addChain({1}, {0.5});
  Host host(none.system, GetParam());
  expect_near({0, {Vec3(), Vec3()}}, host.evaluate(none.positions), 0);
  EXPECT_TRUE(none.force->getContacts(*host).empty());
  EXPECT_EQ(none.force->getNumChains(), 1);
  EXPECT_EQ(none.force->getNumBeads(), 1);
}

TEST_P(ContactForceTest, CoincidingBeads) {
  ContactCase pair;
  pair.add_chain({Vec3(1, 1, 1)}, 0.2);
  pair.add_particle(Vec3(1, 1, 1));
  pair.add_chain({Vec3(1, 1, 1)}, 0.3);
  pair.force->setStrength(4);
  EXPECT_THAT(message_of([&] { evaluate(pair, GetParam()); }),
              testing::HasSubstr("particles 0 and 2 are 0 nm apart, where WCA has no finite energy"));
  pair.force->setStrength(0);
  expect_near({0, {Vec3(), Vec3(), Vec3()}}, evaluate(pair, GetParam()), 0);
  pair.force->setStrength(4);
  pair.force->setEnergyFunction(NecklaceContactForce::Harmonic);
  expect_near({0.5 * 4 * 0.25, {Vec3(), Vec3(), Vec3()}}, evaluate(pair, GetParam()), 1e-14);
  pair.force->setEnergyFunction(NecklaceContactForce::SoftCosine);
  expect_near({8, {Vec3(), Vec3(), Vec3()}}, evaluate(pair, GetParam()), 1e-14);
}

TEST_P(ContactForceTest, FacesOfTheBoxAndFarOutside) {
  const Vec3 box[3] = {Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 2)};
  ContactCase pair;
  pair.set_box(box);
  pair.add_chain({Vec3(0, 0, 0)}, 0.2);
  pair.add_chain({Vec3(0, 0, 0)}, 0.2);
  Host host(pair.system, GetParam());
  const double faces[][2] = {{-1e-17, 0.3}, {2, 1.7},    {0, 1.7},
                             {-0.15, 0.15}, {2e3, 0.25}, {-2e4 + 0.1, 1.8}};
  for (const auto& at : faces) {
    const std::vector<Vec3> positions = {Vec3(2, at[0], -1e-17), Vec3(-2, at[1], 2)};
    const Evaluation expected = all_contacts(*pair.force, positions, box);
    EXPECT_GT(expected.energy, 0);
    expect_near(expected, host.evaluate(positions), 1e-9, std::to_string(at[0]));
    EXPECT_EQ(pair.force->getContacts(*host).size(), 1u);
  }
}

TEST_P(ContactForceTest, ForceGroupsAndOtherForces) {
  ContactCase pair;
  pair.add_chain({Vec3(0, 0, 0), Vec3(0.3, 0, 0)}, 0.2);
  pair.force->setExcludedBonds(0);
  pair.force->setForceGroup(3);
  auto* const bonds = new OpenMM::HarmonicBondForce();
  bonds->addBond(0, 1, 0.1, 50);
  pair.system.addForce(bonds);
  Host host(pair.system, GetParam());
  const double bonded = 0.5 * 50 * 0.04, touching = all_contacts(*pair.force, pair.positions, nullptr).energy;
  EXPECT_NEAR(host.evaluate(pair.positions).energy, bonded + touching, 1e-10 * touching);
  EXPECT_NEAR(host.evaluate(1 << 3).energy, touching, 1e-10 * touching);
  EXPECT_NEAR(host.evaluate(1).energy, bonded, 1e-10);
}

}  // namespace
}  // namespace OpenMMDCH
