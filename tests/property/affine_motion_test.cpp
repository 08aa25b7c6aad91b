// SPDX-License-Identifier: MIT
//
// Boxes that change their shape and take their particles along: a list that is kept lacks no pair within its
// cutoff, and lists are kept though vectors change by more than the skin.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/engines/verlet_list.hpp>
#include <dch/lists/all_pairs.hpp>

#include "effort.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kCutoff = 1.0, kSkin = 0.3, kRadius = kCutoff + kSkin;

ListParams with_skin(double skin) {
  ListParams params;
  params.cutoffs = TypeCutoffs(kCutoff);
  params.skin = skin;
  return params;
}

std::int64_t missing_pairs(const VerletList& kept, const std::vector<Vec3>& points, const Box& box) {
  const NeighborList near = all_pairs(points, box, with_skin(0));
  std::int64_t missing = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const auto row = kept.list().row(i);
    for (const std::int32_t j : near.row(i)) missing += !std::binary_search(row.begin(), row.end(), j);
  }
  return missing;
}

/// A linear map that changes the periodic vectors of a box, and what is at right angles to them in nothing;
/// and a shift of the box along them.
struct Change {
  Change(const Box& of, const std::array<Vec3, 3>& rows, Vec3 by) : box(of) {
    for (int k = 0; k < of.rank(); ++k) {
      const Vec3 period = of.reduced()[k], dual = of.reduced_dual()[k];
      const Vec3 change{dot(rows[0], period), dot(rows[1], period), dot(rows[2], period)};
      for (int axis = 0; axis < 3; ++axis) columns[axis] = columns[axis] + dual[axis] * change;
      shift = shift + dot(dual, by) * period;
    }
  }
  Vec3 vector(Vec3 v) const { return v + (v.x * columns[0] + v.y * columns[1] + v.z * columns[2]); }
  Vec3 place(Vec3 p) const { return box.origin() + shift + vector(p - box.origin()); }
  Box changed() const {
    Vec3 cell[3];
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] = box.periodic(axis) ? vector(box.vector(axis)) : box.vector(axis);
    return Box::triclinic(cell[0], cell[1], cell[2], {box.periodic(0), box.periodic(1), box.periodic(2)},
                          box.origin() + shift);
  }

  const Box& box;
  std::array<Vec3, 3> columns{};
  Vec3 shift;
};

Change random_change(const Box& box, double largest, scenes::Random& random) {
  const auto row = [&] {
    return Vec3{random.uniform(-largest, largest), random.uniform(-largest, largest),
                random.uniform(-largest, largest)};
  };
  const std::array<Vec3, 3> rows{row(), row(), row()};
  return {box, rows, random.in_cube(largest)};
}

/// Along the periodic vectors, by that share of them.
Change even_change(const Box& box, double share) {
  return {box, {Vec3{share, 0, 0}, Vec3{0, share, 0}, Vec3{0, 0, share}}, {}};
}

Vec3 some_periods(const Box& box, scenes::Random& random) {
  Vec3 shift;
  for (int axis = 0; axis < 3; ++axis)
    if (box.periodic(axis)) shift = shift + std::nearbyint(random.uniform(-3, 3)) * box.vector(axis);
  return shift;
}

/// Whether the rule for particles that stay where they are, displacements left out, gives the list up.
bool is_beyond_the_skin(const Box& before, const Change& change) {
  double largest = 0;
  for (int n = 0; n < 27; ++n) {
    Vec3 sum;
    for (int k = 0, rest = n; k < before.rank(); ++k, rest /= 3)
      sum = sum + (rest % 3 - 1.0) * (change.vector(before.reduced()[k]) - before.reduced()[k]);
    largest = std::max(largest, norm2(sum));
  }
  return std::sqrt(largest) > kSkin;
}

class AffineMotion : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(AffineMotion, NoPairIsMissing) {
  const Box& box = GetParam().box;
  if (!box.any_periodic()) return;
  scenes::Random random(21);
  int kept = 0, beyond = 0, stale_though_complete = 0;
  for (int trial = 0; trial < effort(400); ++trial) {
    const auto points = scenes::uniform_in(box, 150, 2000 + static_cast<std::uint64_t>(trial));
    VerletList list(trial % 2 == 0 ? make_cell_search(kRadius) : make_dch_search(kRadius), with_skin(kSkin));
    list.update(points, box);
    const Change change = random_change(box, random.uniform(0, 0.06), random);
    const Box now = change.changed();
    const double step = random.uniform(0, 0.6 * kSkin);
    std::vector<Vec3> moved;
    for (const Vec3 p : points)
      moved.push_back(change.place(p) + random.in_ball(step) + some_periods(now, random));
    if (now.max_cutoff() < kCutoff) continue;
    const std::int64_t missing = missing_pairs(list, moved, now);
    if (list.is_stale(moved, now)) {
      stale_though_complete += missing == 0;
      continue;
    }
    ASSERT_EQ(missing, 0) << "trial " << trial;
    ++kept;
    beyond += is_beyond_the_skin(box, change);
  }
  EXPECT_GT(kept, effort(40)) << "the test says little if nearly all lists are stale";
  EXPECT_GT(beyond, effort(20)) << "nor if none is kept by what moves along";
}

// The worst motion: a pair just beyond the list, along the way that the box shortens most, heads straight for
// each other. To the last moment in an even change, for which the bound is exact.
TEST_P(AffineMotion, PairsThatCloseInHeadOnAreSeen) {
  const Box& box = GetParam().box;
  if (!box.any_periodic()) return;
  scenes::Random random(22);
  for (int trial = 0; trial < effort(300); ++trial) {
    const bool is_even = trial % 2 == 0;
    const Change change = is_even ? even_change(box, -random.uniform(0, 0.02))
                                  : random_change(box, random.uniform(0, 0.03), random);
    const Box now = change.changed();
    Vec3 along = (1 / std::sqrt(norm2(box.reduced()[0]))) * box.reduced()[0];
    for (int k = 0; k < 300; ++k) {
      const Vec3 any = random.in_ball(1), unit = (1 / std::sqrt(norm2(any))) * any;
      if (norm2(change.vector(unit)) < norm2(change.vector(along))) along = unit;
    }
    const Vec3 p = scenes::from_fractional(box, {random.uniform(), random.uniform(), random.uniform()});
    const std::vector<Vec3> start{p, p + kRadius * (1 + 1e-9) * along};
    VerletList list(make_cell_search(kRadius), with_skin(kSkin));
    list.update(start, box);
    ASSERT_EQ(list.list().pairs(), 0);
    const Vec3 apart = change.vector(start[1] - start[0]);
    const double length = std::sqrt(norm2(apart));
    const auto closed_in = [&](double to) {
      const Vec3 step = (0.5 * (length - to) / length) * apart;
      return std::vector<Vec3>{change.place(start[0]) + step + some_periods(now, random),
                               change.place(start[1]) - step + some_periods(now, random)};
    };
    const auto within = closed_in(kCutoff - 1e-8);
    ASSERT_EQ(missing_pairs(list, within, now), 1) << trial;
    ASSERT_TRUE(list.is_stale(within, now)) << trial;
    if (!is_even) continue;
    ASSERT_FALSE(list.is_stale(closed_in(kCutoff + 1e-8), now)) << trial;
  }
}

// Far from where coordinates are small, what cannot be told is stale.
TEST_P(AffineMotion, RoundingTakesFromTheSkin) {
  const Box& near = GetParam().box;
  if (!near.any_periodic()) return;
  scenes::Random random(23);
  int kept = 0;
  for (const double far : {1e3, 1e6, 1e9, 1e11}) {
    const Box box = Box::triclinic(near.vector(0), near.vector(1), near.vector(2),
                                   {near.periodic(0), near.periodic(1), near.periodic(2)}, {far, -far, far});
    for (int trial = 0; trial < effort(60); ++trial) {
      const double skin = std::pow(10, random.uniform(-15, -11)) * far,
                   share = random.uniform(-0.2, 0) * skin;
      const Change change = even_change(box, share);
      const Box now = change.changed();
      const Vec3 p = scenes::from_fractional(box, {random.uniform(), random.uniform(), random.uniform()});
      const Vec3 along = (1 / std::sqrt(norm2(box.reduced()[0]))) * box.reduced()[0];
      const std::vector<Vec3> start{p, p + (kCutoff + 1.01 * skin) * along};
      VerletList list(make_cell_search(kCutoff + skin), with_skin(skin));
      list.update(start, box);
      const Vec3 step = random.uniform(0.3, 0.6) * skin * along;
      const std::vector<Vec3> moved{change.place(start[0]) + step, change.place(start[1]) - step};
      if (list.list().pairs() > 0 || list.is_stale(moved, now)) continue;
      ASSERT_EQ(missing_pairs(list, moved, now), 0) << far << ", trial " << trial;
      ++kept;
    }
  }
  EXPECT_GT(kept, effort(8)) << "the test says little if nearly all lists are stale";
}

INSTANTIATE_TEST_SUITE_P(Boxes, AffineMotion, ::testing::ValuesIn(scenes::all_boxes(6)),
                         [](const auto& test) { return test.param.name; });

// Types and radii: of the largest cutoff the skin loses most.
TEST(AffineMotionOfPairs, TheLargestCutoffCounts) {
  const Box box = Box::orthorhombic({40, 40, 40}), smaller = Box::orthorhombic({39.6, 39.6, 39.6});
  const std::vector<double> radii{0.1, 5};
  ListParams params = with_skin(0.3);
  params.radii = radii;
  VerletList list(make_dch_search(params.list_radius()), params);
  const std::vector<Vec3> points{{1, 1, 1}, {20, 1, 1}};
  list.update(points, box);
  const std::vector<Vec3> along{{0.99, 0.99, 0.99}, {19.8, 0.99, 0.99}};
  const double lost = 0.01 * (10 + 0.3), room = 0.5 * (0.3 - lost);
  const auto moved_by = [&](double step) { return std::vector<Vec3>{along[0], along[1] + Vec3{0, step, 0}}; };
  EXPECT_FALSE(list.is_stale(moved_by(room - 1e-9), smaller));
  EXPECT_TRUE(list.is_stale(moved_by(room + 1e-9), smaller));
}

// Particles that follow from image to image (cluster pairs) must not move by half a period.
TEST(AffineMotionOfPairs, LargeChangesAreLeftToTheRuleForParticlesAtRest) {
  const Box box = Box::orthorhombic({10, 10, 10});
  const std::vector<Vec3> points{{1, 1, 1}, {9, 9, 9}};
  StaleTest test(0.3);
  test.remember(points, box, kRadius);
  const auto grown = [&](double by) {
    const double factor = 1 + by / 10;
    const std::vector<Vec3> along{factor * points[0], factor * points[1]};
    return test.is_stale(along, Box::orthorhombic({10 + by, 10 + by, 10 + by}));
  };
  const double most = 0.5 * (5 - 0.3) / std::sqrt(3.0);
  EXPECT_FALSE(grown(most - 1e-9));
  EXPECT_TRUE(grown(most + 1e-9));
  const auto along_x = [](double length) { return Box::orthorhombic({length, 9, 9}, {true, false, false}); };
  StaleTest of_a_row(0.5);
  of_a_row.remember(std::vector<Vec3>{{1, 1, 1}, {6, 6, 6}}, along_x(8), 1);
  EXPECT_FALSE(of_a_row.is_stale(std::vector<Vec3>{{1.21875, 1, 1}, {7.3125, 6, 6}}, along_x(9.75)))
      << "twice 1.75 and 0.5 are 8 / 2";
}

// The corner of the box, wherever it goes, takes particles along; what is open stays where it is.
TEST(AffineMotionOfPairs, ParticlesGoWithTheCornerOfTheBox) {
  const auto box = [](double length, Vec3 corner) {
    return Box::orthorhombic({length, length, 9}, {true, true, false}, corner);
  };
  StaleTest test(0.3);
  test.remember(std::vector<Vec3>{{4, 5, 6}, {9, 9, 9}}, box(10, {3, 4, 5}), kRadius);
  const Box now = box(11, {1, 7, 2});
  EXPECT_FALSE(test.is_stale(std::vector<Vec3>{{2.1, 8.1, 6}, {7.6, 12.5, 9}}, now));
  EXPECT_TRUE(test.is_stale(std::vector<Vec3>{{2.1, 8.1, 3}, {7.6, 12.5, 6}}, now));
}

}  // namespace
}  // namespace dch
