// SPDX-License-Identifier: MIT
//
// Contacts that are kept up while chains move and boxes change, and parameters that change.
#include "contact_case.hpp"

namespace OpenMMDCH {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

class ContactMotionTest : public OnPlatform {
 protected:
  const Vec3 cube[3] = {Vec3(2.2, 0, 0), Vec3(0, 2.2, 0), Vec3(0, 0, 2.2)};
};
DCH_ON_EACH_PLATFORM(ContactMotionTest);

TEST_P(ContactMotionTest, FollowsChainsStepByStep) {
  for (const Vec3* const box : {static_cast<const Vec3*>(nullptr), cube}) {
    ContactCase tangle;
    make_tangle(tangle, box, 31);
    // Its energy grows the slowest as beads come near each other at random.
    tangle.force->setEnergyFunction(NecklaceContactForce::SoftCosine);
    Host host(tangle.system, GetParam());
    dch::scenes::Random random(32);
    std::vector<Vec3> positions = tangle.positions, velocities(positions.size());
    for (Vec3& v : velocities) v = random.vector<Vec3>(-1, 1) * 0.01;
    for (int step = 0; step < 40; ++step) {
      for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += velocities[i];
      expect_near(all_contacts(*tangle.force, positions, box), host.evaluate(positions), kContactTolerance,
                  "step " + std::to_string(step));
      EXPECT_EQ(tangle.force->getContacts(*host).size(),
                contact_oracle(*tangle.force, positions, box, 0).size());
    }
  }
}

// What is asked for must not depend on whether contacts, or forces, were asked for before.
TEST_P(ContactMotionTest, ContactsAndForcesInAnyOrder) {
  ContactCase tangle;
  make_tangle(tangle, cube, 33);
  Host host(tangle.system, GetParam());
  host->setPositions(tangle.positions);
  EXPECT_FALSE(tangle.force->getContacts(*host, 0.2).empty());
  const Evaluation expected = all_contacts(*tangle.force, tangle.positions, cube);
  expect_near(expected, host.evaluate(), kContactTolerance);
  EXPECT_FALSE(tangle.force->getContacts(*host, -0.05).empty());
  expect_near(expected, host.evaluate(tangle.positions), kContactTolerance);
}

TEST_P(ContactMotionTest, FollowsABoxThatChangesEveryStep) {
  ContactCase tangle;
  make_tangle(tangle, cube, 41);
  tangle.force->setEnergyFunction(NecklaceContactForce::Harmonic);
  Host host(tangle.system, GetParam());
  for (int step = 0; step < 40; ++step) {
    const double scale = 1 - 0.015 * (step < 20 ? step : 40 - step), shear = 0.02 * step;
    const Vec3 now[3] = {cube[0] * scale, Vec3(shear, cube[1][1], 0) * scale, cube[2] * scale};
    std::vector<Vec3> positions = tangle.positions;
    for (Vec3& p : positions) p = Vec3(p[0] + shear * p[1] / cube[1][1], p[1], p[2]) * scale;
    host->setPeriodicBoxVectors(now[0], now[1], now[2]);
    expect_near(all_contacts(*tangle.force, positions, now), host.evaluate(positions), kContactTolerance,
                "step " + std::to_string(step));
  }
}

TEST_P(ContactMotionTest, FollowsJumpsAndTeleports) {
  ContactCase tangle;
  make_tangle(tangle, cube, 51);
  ContactCase other;
  make_tangle(other, cube, 52);
  Host host(tangle.system, GetParam());
  dch::scenes::Random random(53);
  for (int step = 0; step < 10; ++step) {
    std::vector<Vec3> positions = step % 2 == 0 ? tangle.positions : other.positions;
    for (Vec3& p : positions)
      p += cube[0] * static_cast<double>(random.below(9)) - cube[1] * static_cast<double>(random.below(9));
    // The jumps round away what they are longer than the box.
    expect_near(all_contacts(*tangle.force, positions, cube), host.evaluate(positions), 1e-9,
                "step " + std::to_string(step));
  }
}

/// A chain row by row and layer by layer through a lattice, which the seed puts into disorder.
std::vector<Vec3> packed_chain(int side, double spacing, std::uint64_t seed) {
  dch::scenes::Random random(seed);
  std::vector<Vec3> chain;
  for (int z = 0; z < side; ++z)
    for (int k = 0; k < side; ++k)
      for (int n = 0; n < side; ++n) {
        const int y = z % 2 == 0 ? k : side - 1 - k;
        const int x = (y + z) % 2 == 0 ? n : side - 1 - n;
        const dch::Vec3 off = random.in_ball(0.1 * spacing);
        chain.push_back(Vec3(x, y, z) * spacing + Vec3(off.x, off.y, off.z));
      }
  return chain;
}

// The first search is the wrapped hierarchy's; from then on counted work decides.
TEST_P(ContactMotionTest, PackedChainsAreSearchedOverSpaceAndStretchedOnesAlongTheChain) {
  for (const bool is_packed : {true, false})
    for (const Vec3* const box : {static_cast<const Vec3*>(nullptr), cube}) {
      ContactCase chain;
      if (box) chain.set_box(box);
      std::vector<Vec3> beads = packed_chain(6, 0.3, 3);
      if (!is_packed)
        for (std::size_t k = 0; k < beads.size(); ++k)
          beads[k] = Vec3(0.15 * static_cast<double>(k), k % 2 == 0 ? 0 : 0.1, 0);
      // Around the box the long straight chain would lie on itself.
      if (box && !is_packed) beads.resize(14);
      chain.add_chain(beads, 0.16);
      chain.force->setEnergyFunction(NecklaceContactForce::SoftCosine);
      Host host(chain.system, GetParam());
      EXPECT_THAT(chain.force->getSearchInContext(*host), HasSubstr("wrapped: no search yet"));
      dch::scenes::Random random(4);
      for (int step = 0; step < 4; ++step) {
        for (Vec3& p : beads) p += Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0) * 0.02;
        const std::string what =
            (is_packed ? "packed" : "stretched") + std::string(", step ") + std::to_string(step);
        expect_near(all_contacts(*chain.force, beads, box), host.evaluate(beads), kContactTolerance, what);
        const auto expected = contact_oracle(*chain.force, beads, box, 0.05);
        const auto found = chain.force->getContacts(*host, 0.05);
        ASSERT_EQ(found.size(), expected.size()) << what;
        for (std::size_t k = 0; k < found.size(); ++k) {
          EXPECT_EQ(found[k].particle1, expected[k].particle1) << what;
          EXPECT_EQ(found[k].particle2, expected[k].particle2) << what;
        }
        EXPECT_THAT(chain.force->getSearchInContext(*host),
                    HasSubstr(is_packed ? "above 1.80: the DCH" : "below 1.40: the wrapped hierarchy"))
            << what;
      }
    }
}

// The hierarchy over space, which a packed chain is searched with, would not need the bond.
TEST_P(ContactMotionTest, BondsThatDoNotFitAreRefusedInPackedChainsToo) {
  ContactCase chain;
  chain.set_box(cube);
  chain.add_chain(packed_chain(6, 0.3, 3), 0.16);
  chain.force->setEnergyFunction(NecklaceContactForce::SoftCosine);
  Host host(chain.system, GetParam());
  host.evaluate(chain.positions);
  ASSERT_THAT(chain.force->getSearchInContext(*host), testing::StartsWith("dch: "));
  std::vector<Vec3> torn = chain.positions;
  for (std::size_t k = 0; k < 108; ++k) torn[k] += Vec3(1, 1, 1);
  EXPECT_THAT(message_of([&] { host.evaluate(torn); }),
              HasSubstr("NecklaceContactForce: bond 107-108 is 1."));
  expect_near(all_contacts(*chain.force, chain.positions, cube), host.evaluate(chain.positions),
              kContactTolerance);
}

TEST_P(ContactMotionTest, BoxesAndBondsThatDoNotFitAreRefused) {
  ContactCase chain;
  chain.set_box(cube);
  chain.add_chain({Vec3(0, 0, 0), Vec3(0.3, 0, 0), Vec3(0.3, 0.3, 0), Vec3(0, 0.3, 0)}, 0.25);
  Host host(chain.system, GetParam());
  const auto expect_right = [&] {
    expect_near(all_contacts(*chain.force, chain.positions, cube), host.evaluate(chain.positions),
                kContactTolerance);
  };
  expect_right();
  host->setPeriodicBoxVectors(cube[0], Vec3(0, 0.95, 0), cube[2]);
  EXPECT_THAT(message_of([&] { host.evaluate(chain.positions); }),
              testing::AllOf(HasSubstr("twice the largest radius is 0.5 nm"), HasSubstr("0.475 nm")));
  host->setPeriodicBoxVectors(cube[0], cube[1], cube[2]);
  expect_right();
  std::vector<Vec3> stretched = chain.positions;
  stretched[3] += Vec3(0, 0, 1.1);
  EXPECT_THAT(message_of([&] { host.evaluate(stretched); }),
              testing::AllOf(HasSubstr("NecklaceContactForce: bond 2-3 is 1.1401"), HasSubstr("1.1")));
  expect_right();
  EXPECT_THAT(message_of([&] { chain.force->getContacts(*host, 0.61); }), HasSubstr("1.11"));
  EXPECT_THAT(message_of([&] { chain.force->getContacts(*host, NAN); }), HasSubstr("gap is nan"));
  EXPECT_EQ(chain.force->getContacts(*host, 0.55).size(), 3u);
  expect_right();
}

TEST_P(ContactMotionTest, ARingThatWindsAroundTheBoxIsRefused) {
  ContactCase ring;
  ring.set_box(cube);
  ring.add_chain({Vec3(0.1, 0, 0), Vec3(0.8, 0, 0), Vec3(1.5, 0, 0)}, 0.1, true);
  EXPECT_THAT(message_of([&] { evaluate(ring, GetParam()); }), HasSubstr("winds around the periodic box"));
  ring.force->setUsesPeriodicBoundaryConditions(false);
  EXPECT_EQ(evaluate(ring, GetParam()).energy, 0);
}

TEST_P(ContactMotionTest, PositionsThatAreNotFinite) {
  ContactCase tangle;
  make_tangle(tangle, nullptr, 61);
  Host host(tangle.system, GetParam());
  std::vector<Vec3> positions = tangle.positions;
  positions[7][1] = std::numeric_limits<double>::quiet_NaN();
  // The CPU platform sees it before its forces do.
  EXPECT_THAT(
      message_of([&] { host.evaluate(positions); }),
      ContainsRegex(GetParam() == "CPU" ? "coordinate is (nan|NaN)" : "bead 7 has the coordinate nan"));
  expect_near(all_contacts(*tangle.force, tangle.positions, nullptr), host.evaluate(tangle.positions),
              kContactTolerance);
}

TEST_P(ContactMotionTest, UpdateParametersInContext) {
  ContactCase tangle;
  make_tangle(tangle, cube, 71);
  NecklaceContactForce& force = *tangle.force;
  Host host(tangle.system, GetParam());
  const Evaluation before = host.evaluate(tangle.positions);
  expect_near(all_contacts(force, tangle.positions, cube), before, kContactTolerance, "before");
  force.setStrength(2.5);
  std::vector<int> particles;
  std::vector<double> radii;
  bool closed;
  for (int index = 0; index < force.getNumChains(); ++index) {
    force.getChainParameters(index, particles, radii, closed);
    for (double& radius : radii) radius *= 1.2;
    force.setChainParameters(index, particles, radii, closed);
  }
  expect_near(before, host.evaluate(), 0, "not yet");
  force.updateParametersInContext(*host);
  expect_near(all_contacts(force, tangle.positions, cube), host.evaluate(), kContactTolerance, "after");
}

// Bonds and contacts at constant energy: forces are the slope of the energy whatever pairs were kept.
TEST_P(ContactMotionTest, EnergyIsConserved) {
  for (const auto function : kEnergyFunctions) {
    ContactCase tangle;
    make_tangle(tangle, cube, 81);
    tangle.force->setEnergyFunction(function);
    tangle.force->setStrength(function == NecklaceContactForce::WCA ? 1 : 100);
    auto* const bonds = new OpenMM::HarmonicBondForce();
    std::vector<int> particles;
    std::vector<double> radii;
    bool closed;
    for (int index = 0; index < tangle.force->getNumChains(); ++index) {
      tangle.force->getChainParameters(index, particles, radii, closed);
      for (std::size_t k = closed ? 0 : 1; k < particles.size(); ++k)
        bonds->addBond(particles[(k + particles.size() - 1) % particles.size()], particles[k], 0.25, 2000);
    }
    bonds->setUsesPeriodicBoundaryConditions(true);
    bonds->setForceGroup(1);
    tangle.system.addForce(bonds);
    OpenMM::VerletIntegrator integrator(0.002);
    OpenMM::Context context(tangle.system, integrator, OpenMM::Platform::getPlatformByName(GetParam()));
    context.setPositions(tangle.positions);
    OpenMM::LocalEnergyMinimizer::minimize(context, 10);
    context.setVelocitiesToTemperature(300, 5);
    const auto energy = [&] {
      const OpenMM::State state = context.getState(OpenMM::State::Energy);
      return state.getPotentialEnergy() + state.getKineticEnergy();
    };
    integrator.step(50);
    const double before = energy(), kinetic = context.getState(OpenMM::State::Energy).getKineticEnergy();
    integrator.step(500);
    EXPECT_NEAR(energy(), before, 0.005 * kinetic) << "function " << function;
    const OpenMM::State state = context.getState(OpenMM::State::Positions);
    expect_near(all_contacts(*tangle.force, state.getPositions(), cube).energy,
                context.getState(OpenMM::State::Energy, false, 1 << 0).getPotentialEnergy(), 1e-9,
                "function " + std::to_string(function));
  }
}

}  // namespace
}  // namespace OpenMMDCH
