// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include <dch/necklace/bond_encounter.hpp>
#include <dch/necklace/knots.hpp>

#include "effort.hpp"
#include "random.hpp"

namespace {

using dch::Vec3;
using dch::necklace::bond_encounter;
using dch::necklace::BondEncounter;
using dch::necklace::linking_number;
using dch::necklace::MovingBond;
using dch::scenes::Random;

constexpr MovingBond kAlongX{{-1, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {1, 0, 0}};

/// Across kAlongX in its middle, at a height that goes from one value to another.
MovingBond across(double from, double to) { return {{0, -1, from}, {0, 1, from}, {0, -1, to}, {0, 1, to}}; }

int sum(const BondEncounter& encounter) {
  int result = 0;
  for (int k = 0; k < encounter.count; ++k) result += encounter.crossings[static_cast<std::size_t>(k)].sign;
  return result;
}

TEST(Degenerate, DoubleRootIsAContact) {
  // f(t) = 4 (t - 1/2)^2
  const MovingBond q{{0, -1, 0.25}, {0, 1, 0}, {0, -2, -1.75}, {0, 1, 1}};
  const BondEncounter found = bond_encounter(kAlongX, q);
  EXPECT_EQ(found.count, 0);
  EXPECT_TRUE(found.contact);
  EXPECT_NEAR(found.contact_time, 0.5, 5e-3);
  // Whichever way the perturbation of these beads goes, to two crossings or to none.
  for (std::uint64_t bead = 0; bead < 8; ++bead)
    EXPECT_EQ(bond_encounter(kAlongX, q, 0, {bead, bead + 1, bead + 2, bead + 3}).count, 0) << bead;
  // A unit in the last place of the height apart: two crossings, or none.
  const auto moved = [&](double by) {
    MovingBond other = q;
    for (Vec3* end : {&other.from_a, &other.from_b, &other.to_a, &other.to_b}) end->z += by;
    return bond_encounter(kAlongX, other);
  };
  EXPECT_EQ(moved(-0x1p-52).count, 2);
  EXPECT_EQ(sum(moved(-0x1p-52)), 0);
  EXPECT_EQ(moved(0x1p-52).count, 0);
}

TEST(Degenerate, AnEventAtTheCommonTimeOfTwoStepsCountsOnce) {
  const auto both = [](double first, double second, double third) {
    const BondEncounter a = bond_encounter(kAlongX, across(first, second));
    const BondEncounter b = bond_encounter(kAlongX, across(second, third));
    EXPECT_LE(a.count + b.count, 2);
    return std::pair(a.count + b.count, sum(a) + sum(b));
  };
  EXPECT_EQ(both(1, 0, -1), std::pair(1, 1));
  EXPECT_EQ(both(-1, 0, 1), std::pair(1, -1));
  // There and back: the perturbed bonds may cross twice, but the signs cancel.
  EXPECT_EQ(both(1, 0, 1).second, 0);
  EXPECT_EQ(both(-1, 0, -1).second, 0);
  EXPECT_EQ(both(1, 0, 1).first % 2, 0);
  // At rest in between.
  EXPECT_EQ(bond_encounter(kAlongX, across(0, 0)).count, 0);
  EXPECT_TRUE(bond_encounter(kAlongX, across(0, 0)).contact);
}

TEST(Degenerate, APassageThroughACommonBeadCountsOnce) {
  // A chain along x with a bead, number 1, where q passes.
  const MovingBond left{{-1, 0, 0}, {0, 0, 0}, {-1, 0, 0}, {0, 0, 0}};
  for (const Vec3 end : {Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 1}, Vec3{0.5, -1, 2}}) {
    const MovingBond right{{0, 0, 0}, end, {0, 0, 0}, end};
    const MovingBond q = across(1, -1);
    const BondEncounter on_left = bond_encounter(left, q, 0, {0, 1, 5, 6});
    const BondEncounter on_right = bond_encounter(right, q, 0, {1, 2, 5, 6});
    // To the side in x an end at x > 0 continues the chain; the last but one does not leave the bead
    // sideways.
    if (end.x > 0 && end.z == 0) {
      EXPECT_EQ(on_left.count + on_right.count, 1) << end.x << end.y << end.z;
      EXPECT_EQ(sum(on_left) + sum(on_right), 1);
    }
    EXPECT_LE(on_left.count + on_right.count, 2);
  }
  // Folded back on the same side: through both or none.
  const MovingBond folded{{0, 0, 0}, {-1, 0, 0.0}, {0, 0, 0}, {-1, 0, 0}};
  EXPECT_EQ(sum(bond_encounter(left, across(1, -1), 0, {0, 1, 5, 6})) +
                sum(bond_encounter(folded, across(1, -1), 0, {1, 2, 5, 6})),
            0);
}

TEST(Degenerate, MotionInAPlaneIsAContact) {
  const MovingBond q{{3, -1, 0}, {3, 1, 0}, {-3, -1, 0}, {-3, 1, 0}};
  const BondEncounter through = bond_encounter(kAlongX, q);
  EXPECT_EQ(sum(through), 0);
  EXPECT_TRUE(through.contact || through.count > 0);
  const MovingBond beside{{3, 1, 0}, {3, 2, 0}, {-3, 1, 0}, {-3, 2, 0}};
  const BondEncounter past = bond_encounter(kAlongX, beside);
  EXPECT_EQ(past.count, 0);
  EXPECT_FALSE(past.contact);
}

TEST(Degenerate, ParallelAndCollinearBonds) {
  const MovingBond slides{{2, 0, 0}, {3, 0, 0}, {-3, 0, 0}, {-2, 0, 0}};
  EXPECT_EQ(sum(bond_encounter(kAlongX, slides)), 0);
  EXPECT_TRUE(bond_encounter(kAlongX, slides).contact);
  const MovingBond apart{{-1, 0, 1}, {1, 0, 1}, {-1, 0, 0.5}, {1, 0, 0.5}};
  EXPECT_EQ(bond_encounter(kAlongX, apart).count, 0);
  EXPECT_FALSE(bond_encounter(kAlongX, apart).contact);
}

TEST(Degenerate, BondsOfNoLengthMeetNothing) {
  const MovingBond point{{0, 0, 1}, {0, 0, 1}, {0, 0, -1}, {0, 0, -1}};
  EXPECT_LE(bond_encounter(kAlongX, point).count, 1);
  EXPECT_EQ(bond_encounter(point, point).count, 0);
}

TEST(Degenerate, EndOverEndIsNoCrossing) {
  // q turns about its lower end, over the end of p at x = 1.
  const MovingBond q{{1.5, 0, -1}, {1.5, 0, 1}, {1.5, 0, -1}, {0, 0, 1}};
  EXPECT_EQ(bond_encounter(kAlongX, q).count, 0);
}

/// Rings with corners on a small grid whose corners jump over it: nearly all motions are degenerate, in a
/// plane, along a line, at rest, through corners, at the beginning and end of steps. Signs still sum up to
/// the change of the linking number between any two times at which the rings do not touch.
TEST(Degenerate, SignsOnAGridSumUpToTheChangeOfTheLinkingNumber) {
  Random random(11);
  int compared = 0, changed = 0;
  constexpr std::size_t kSide = 4;
  const auto on_grid = [&] {
    const auto number = [&] { return static_cast<double>(random.below(kSide)); };
    const double x = number(), y = number();
    return Vec3{x, y, number()};
  };
  for (int scene = 0; scene < dch::effort(24); ++scene) {
    std::array<std::vector<Vec3>, 2> now;
    for (auto& ring : now) {
      ring.resize(3 + random.below(3));
      for (Vec3& corner : ring) corner = on_grid();
    }
    std::int64_t sum_of_signs = 0, last = 0;
    bool is_known = false;
    for (int step = 0; step < 6; ++step) {
      try {
        const std::int64_t here = linking_number(now[0], now[1]);
        if (is_known) {
          EXPECT_EQ(here - last, sum_of_signs) << "scene " << scene << ", step " << step;
          ++compared;
          changed += here != last ? 1 : 0;
        }
        last = here;
        sum_of_signs = 0;
        is_known = true;
      } catch (const dch::necklace::RingsTouch&) {
      }
      auto next = now;
      for (auto& ring : next) {
        for (Vec3& corner : ring) corner = random.below(2) == 0 ? on_grid() : corner;
      }
      for (std::size_t i = 0; i < now[0].size(); ++i) {
        for (std::size_t j = 0; j < now[1].size(); ++j) {
          const std::size_t i1 = (i + 1) % now[0].size(), j1 = (j + 1) % now[1].size();
          sum_of_signs += sum(bond_encounter({now[0][i], now[0][i1], next[0][i], next[0][i1]},
                                             {now[1][j], now[1][j1], next[1][j], next[1][j1]}, 0,
                                             {i, i1, 100 + j, 100 + j1}));
        }
      }
      now = next;
    }
  }
  EXPECT_GT(compared, 2 * dch::effort(24));
  EXPECT_GT(changed, dch::effort(24) / 2);
}

}  // namespace
