// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/necklace/bond_encounter.hpp>

#include "crossing/cubic_passages.hpp"
#include "crossing/exact_crossings.hpp"
#include "crossing_oracle.hpp"
#include "effort.hpp"
#include "error_message.hpp"
#include "random.hpp"

namespace {

using dch::Vec3;
using dch::necklace::bond_encounter;
using dch::necklace::BondEncounter;
using dch::necklace::EncounterStage;
using dch::necklace::MovingBond;
using dch::scenes::Random;

/// A multiple of 2^-bits.
Vec3 rounded(Vec3 v, int bits) {
  for (int axis = 0; axis < 3; ++axis) v[axis] = std::ldexp(std::nearbyint(std::ldexp(v[axis], bits)), -bits);
  return v;
}

/// Motions of many kinds: slow and fast, near and far from the origin, nearly parallel, in one plane but for
/// a few units of the last place, on coarse grids.
std::array<MovingBond, 2> random_motion(Random& random, std::size_t kind) {
  std::array<MovingBond, 2> bonds;
  const double speed = random.uniform(0.05, 2), spread = random.uniform(0.1, 1.2);
  const int bits = kind == 1 ? 2 : kind == 2 ? 4 : 45;
  const Vec3 origin = kind == 3 ? rounded(random.in_cube(1000), 40) : Vec3{};
  const Vec3 common = random.in_ball(0.6);
  for (MovingBond& bond : bonds) {
    const Vec3 center = random.in_cube(kind == 4 ? 0.1 * spread : spread);
    Vec3 half = random.in_ball(0.6);
    if (kind == 4) half = common + std::ldexp(1.0, -static_cast<int>(random.below(40))) * half;
    bond.from_a = center + half;
    bond.from_b = center - half;
    bond.to_a = bond.from_a + random.in_ball(speed);
    bond.to_b = bond.from_b + random.in_ball(speed);
    for (Vec3* end : {&bond.from_a, &bond.from_b, &bond.to_a, &bond.to_b}) {
      if (kind == 5) end->z *= 1e-12;
      *end = rounded(origin + *end, kind == 3 ? 40 : bits);
    }
  }
  return bonds;
}

void expect_equal(const BondEncounter& found, const std::vector<dch::crossing_oracle::Event>& events,
                  int number) {
  ASSERT_EQ(static_cast<std::size_t>(found.count), events.size()) << "motion " << number;
  for (std::size_t k = 0; k < events.size(); ++k) {
    EXPECT_EQ(found.crossings[k].sign, -events[k].sign) << "motion " << number;
    EXPECT_NEAR(found.crossings[k].time, events[k].time, 1e-6) << "motion " << number;
    if (k > 0) {
      EXPECT_LE(found.crossings[k - 1].time, found.crossings[k].time) << "motion " << number;
    }
  }
}

TEST(BondEncounter, EqualsExactArithmeticForRandomMotions) {
  const bool is_long = std::getenv("DCH_TEST_LONG") != nullptr;
  const int count = is_long ? 1000000 : dch::effort(8000);
  Random random(20261124);
  std::int64_t crossings = 0, generic = 0;
  std::array<std::int64_t, 3> stages{};
  for (int number = 0; number < count; ++number) {
    const auto [p, q] = random_motion(random, static_cast<std::size_t>(number) % 8);
    const BondEncounter found = bond_encounter(p, q);
    ++stages[static_cast<std::size_t>(found.decided_by)];
    const auto events = dch::crossing_oracle::Oracle(p, q).events();
    if (!events) continue;
    ++generic;
    crossings += static_cast<std::int64_t>(events->size());
    expect_equal(found, *events, number);
    if (HasFatalFailure()) return;
  }
  std::cout << count << " motions, seed 20261124: " << generic << " generic, " << crossings
            << " crossings; zonotope " << stages[0] << ", cubic " << stages[1] << ", exact " << stages[2]
            << "\n";
  EXPECT_GT(generic, count * 3 / 5);
  EXPECT_GT(crossings, count / 60);
  for (const std::int64_t stage : stages) EXPECT_GT(stage, count / 200);
}

TEST(BondEncounter, IntegersAloneFindWhatDoublesFind) {
  Random random(7);
  int crossings = 0;
  for (int number = 0; number < dch::effort(600); ++number) {
    const auto [p, q] = random_motion(random, 0);
    dch::necklace::detail::PairEnds ends;
    ends.from = {{{p.from_a, {}}, {p.from_b, {}}, {q.from_a, {}}, {q.from_b, {}}}};
    ends.to = {{{p.to_a, {}}, {p.to_b, {}}, {q.to_a, {}}, {q.to_b, {}}}};
    const auto exact = dch::necklace::detail::exact_passages(ends);
    const BondEncounter found = bond_encounter(p, q);
    EXPECT_FALSE(exact.degenerate);
    ASSERT_EQ(static_cast<std::size_t>(found.count), exact.passages.size()) << number;
    for (std::size_t k = 0; k < exact.passages.size(); ++k, ++crossings) {
      EXPECT_NEAR(found.crossings[k].time, exact.passages[k].time, 1e-9);
      EXPECT_NEAR(found.crossings[k].on_p, exact.passages[k].on_p, 1e-7);
      EXPECT_NEAR(found.crossings[k].on_q, exact.passages[k].on_q, 1e-7);
      EXPECT_EQ(found.crossings[k].sign, -exact.passages[k].sign);
    }
  }
  EXPECT_GT(crossings, 10);
}

TEST(BondEncounter, SaysTimePlaceAndSign) {
  const MovingBond p{{-1, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
  const MovingBond q{{0.5, -1, 1}, {0.5, 3, 1}, {0.5, -1, -3}, {0.5, 3, -3}};
  const BondEncounter found = bond_encounter(p, q);
  ASSERT_EQ(found.count, 1);
  EXPECT_EQ(found.decided_by, EncounterStage::cubic);
  EXPECT_NEAR(found.crossings[0].time, 0.25, 1e-12);
  EXPECT_NEAR(found.crossings[0].on_p, 0.75, 1e-12);
  EXPECT_NEAR(found.crossings[0].on_q, 0.25, 1e-12);
  EXPECT_NEAR(found.crossings[0].place.x, 0.5, 1e-12);
  EXPECT_EQ(found.crossings[0].sign,
            1);  // q is over p first: -1, then p over q: +1 of this overlap, by half each
  EXPECT_FALSE(found.contact);
  const BondEncounter back = bond_encounter(p, {q.to_a, q.to_b, q.from_a, q.from_b});
  ASSERT_EQ(back.count, 1);
  EXPECT_EQ(back.crossings[0].sign, -1);
}

TEST(BondEncounter, PathsThatCrossAtDifferentTimesAreRejectedByTheZonotope) {
  const MovingBond p{{-1, 0, 0}, {1, 0, 0}, {-1, 0, 4}, {1, 0, 4}};
  const MovingBond q{{0, -1, 1}, {0, 1, 1}, {0, -1, 5}, {0, 1, 5}};
  const BondEncounter found = bond_encounter(p, q);
  EXPECT_EQ(found.count, 0);
  EXPECT_EQ(found.decided_by, EncounterStage::zonotope);
}

TEST(BondEncounter, SeveralCrossingsInOneStepAreAllReported) {
  // The double root of Degenerate.DoubleRoot, apart by a little.
  const double by = 0.01;
  const MovingBond p{{-1, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
  const MovingBond q{{0, -1, 0.25 - by}, {0, 1, -by}, {0, -2, -1.75 - by}, {0, 1, 1 - by}};
  const BondEncounter found = bond_encounter(p, q);
  ASSERT_EQ(found.count, 2);
  EXPECT_LT(found.crossings[0].time, found.crossings[1].time);
  EXPECT_EQ(found.crossings[0].sign, -found.crossings[1].sign);
}

TEST(BondEncounter, ContactsAreWithinTheThickness) {
  const MovingBond p{{-1, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
  const MovingBond q{{0, -1, 2}, {0, 1, 2}, {0, -1, 0.5}, {0, 1, 0.5}};
  EXPECT_FALSE(bond_encounter(p, q, 0.49).contact);
  EXPECT_FALSE(bond_encounter(p, q).contact);
  const BondEncounter found = bond_encounter(p, q, 0.75);
  EXPECT_TRUE(found.contact);
  EXPECT_EQ(found.count, 0);
  EXPECT_NEAR(found.contact_time, 1.25 / 1.5, 1e-5);
  EXPECT_NEAR(found.contact_distance, 0.75, 1e-5);
}

TEST(BondEncounter, ContactsEqualASampleOfDistances) {
  Random random(3);
  int contacts = 0;
  for (int number = 0; number < dch::effort(400); ++number) {
    const auto [p, q] = random_motion(random, 0);
    const dch::necklace::detail::PairMotion motion(p, q, 4);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 200; ++k) {
      const double t = k / 200.0;
      for (int u = 0; u <= 20; ++u) {
        for (int v = 0; v <= 20; ++v) {
          const Vec3 d = motion.at(motion.between, t) + (v / 20.0) * motion.at(motion.bond_q, t) -
                         (u / 20.0) * motion.at(motion.bond_p, t);
          least = std::min(least, norm2(d));
        }
      }
    }
    const double sampled = std::sqrt(least), slack = 0.1;  // of samples so far apart
    const double thickness = random.uniform(0.01, 0.5);
    const bool contact = bond_encounter(p, q, thickness).contact;
    if (sampled <= thickness) {
      EXPECT_TRUE(contact) << number;
    }
    if (sampled > thickness + slack) {
      EXPECT_FALSE(contact) << number;
    }
    contacts += contact ? 1 : 0;
  }
  EXPECT_GT(contacts, 20);
}

TEST(BondEncounter, RefusesBadInput) {
  const MovingBond p{{-1, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
  MovingBond q = p;
  using dch::InvalidParameter;
  EXPECT_THROW(bond_encounter(p, q, -1), InvalidParameter);
  EXPECT_THROW(bond_encounter(p, q, std::numeric_limits<double>::quiet_NaN()), InvalidParameter);
  q.to_a.y = std::numeric_limits<double>::infinity();
  EXPECT_THROW(bond_encounter(p, q), dch::InvalidPosition);
}

}  // namespace
