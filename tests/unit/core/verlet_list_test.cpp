// SPDX-License-Identifier: MIT
//
// More than 300 lines: the stale test and the list that goes by it, one scene a clause.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/engines/verlet_list.hpp>
#include <dch/lists/all_pairs.hpp>

#include "scenes.hpp"

namespace dch {
namespace {

ListParams with_skin(double cutoff, double skin) {
  ListParams params;
  params.cutoffs = TypeCutoffs(cutoff);
  params.skin = skin;
  return params;
}

VerletList verlet_list(double cutoff, double skin) {
  return {make_cell_search(cutoff + skin), with_skin(cutoff, skin)};
}

/// The first pair within the cutoff that the list lacks.
std::string missing_pair(const VerletList& verlet, const std::vector<Vec3>& points, const Box& box,
                         double cutoff) {
  const NeighborList near = all_pairs(points, box, with_skin(cutoff, 0));
  for (std::size_t i = 0; i < near.size(); ++i) {
    const auto row = verlet.list().row(i);
    for (const std::int32_t j : near.row(i)) {
      if (!std::binary_search(row.begin(), row.end(), j)) return std::to_string(i) + ", " + std::to_string(j);
    }
  }
  return {};
}

TEST(VerletList, StaleBeyondHalfTheSkin) {
  const Box box = Box::orthorhombic({10, 10, 10});
  std::vector<Vec3> points{{1, 1, 1}, {9, 9, 9}, {5, 5, 5}};
  auto verlet = verlet_list(2, 0.5);
  EXPECT_TRUE(verlet.is_stale(points, box)) << "not built yet";
  EXPECT_TRUE(verlet.update(points, box));
  EXPECT_FALSE(verlet.update(points, box));
  EXPECT_EQ(verlet.rebuilds(), 1);

  points[1] = {9.25 - 1e-9, 9, 9};
  EXPECT_FALSE(verlet.is_stale(points, box)) << "half the skin but for rounding";
  points[1] = {9.25 + 1e-9, 9, 9};
  EXPECT_TRUE(verlet.is_stale(points, box));
  points[1] = {9.25 - 1e-9 - 30, 9, 19};
  EXPECT_FALSE(verlet.is_stale(points, box)) << "images are the same point";
  points[1] = {9, 9, 9.3};
  EXPECT_TRUE(verlet.update(points, box));
  EXPECT_FALSE(verlet.is_stale(points, box));
  EXPECT_EQ(verlet.rebuilds(), 2);
}

TEST(VerletList, WithoutSkinAnyMotionIsStale) {
  const std::vector<Vec3> points{{1, 1, 1}, {2, 2, 2}};
  auto verlet = verlet_list(2, 0);
  verlet.update(points, Box::none());
  EXPECT_FALSE(verlet.is_stale(points, Box::none()));
  EXPECT_TRUE(verlet.is_stale(std::vector<Vec3>{{1, 1, 1}, {2, 2, 2.0000001}}, Box::none()));
  const Box box = Box::orthorhombic({10, 10, 10});
  verlet.update(points, box);
  EXPECT_FALSE(verlet.is_stale(points, box));
  EXPECT_TRUE(verlet.is_stale(points, Box::orthorhombic({10, 10, std::nextafter(10, 11)})));
}

TEST(VerletList, BoxChangeTakesFromTheSkin) {
  const std::vector<Vec3> points{{1, 1, 1}, {9, 9, 9}};
  auto verlet = verlet_list(2, 0.5);
  const auto box = [](double x) { return Box::orthorhombic({x, 10, 10}); };
  verlet.update(points, box(10));
  EXPECT_FALSE(verlet.is_stale(points, box(10.5 - 1e-9))) << "the whole skin";
  EXPECT_FALSE(verlet.is_stale(points, box(9.5 + 1e-9)));
  EXPECT_TRUE(verlet.is_stale(points, box(10.5 + 1e-9)));
  EXPECT_TRUE(verlet.is_stale(points, box(9.5 - 1e-9)));

  std::vector<Vec3> moved = points;
  moved[0].y += 0.125;
  EXPECT_FALSE(verlet.is_stale(moved, box(9.75 + 1e-9)));
  EXPECT_TRUE(verlet.is_stale(moved, box(9.75 - 1e-9)));

  moved = points;
  moved[0].x += 10.25;
  EXPECT_FALSE(verlet.is_stale(moved, box(10.25))) << "an image in the present box, not in that of the build";
  moved[0].x = points[0].x + 10;
  EXPECT_TRUE(verlet.is_stale(moved, box(10.5)));
}

TEST(VerletList, ParticlesThatGoAlongWithTheBoxTakeNothingFromTheSkin) {
  const std::vector<Vec3> points{{1, 1, 1}, {9, 9, 9}};
  auto verlet = verlet_list(2, 0.5);
  verlet.update(points, Box::orthorhombic({10, 10, 10}));
  const auto is_stale = [&](double scale, double step) {
    const std::vector<Vec3> moved{scale * points[0] + Vec3{0, step, 0}, scale * points[1]};
    return verlet.is_stale(moved, Box::orthorhombic({10 * scale, 10 * scale, 10 * scale}));
  };
  EXPECT_FALSE(is_stale(1.1, 0.25 - 1e-9)) << "distances have grown";
  EXPECT_TRUE(is_stale(1.1, 0.25 + 1e-9));
  const double lost = 0.05 * 2.5;
  EXPECT_FALSE(is_stale(0.95, 0.25 - 0.5 * lost - 1e-9)) << "a pair at the list radius has come nearer";
  EXPECT_TRUE(is_stale(0.95, 0.25 - 0.5 * lost + 1e-9));
}

TEST(VerletList, ChangesOfCellVectorsAddUpInTheWorstWay) {
  // Whichever the change is, one of them does not move along with it.
  std::vector<Vec3> points;
  for (const double x : {1, 9})
    for (const double y : {1, 9})
      for (const double z : {1, 9}) points.push_back({x, y, z});
  auto verlet = verlet_list(2, 0.375);
  verlet.update(points, Box::orthorhombic({10, 10, 10}));
  for (const double a : {-0.125, 0.125}) {
    for (const double b : {-0.125, 0.125}) {
      for (const double c : {-0.125, 0.125}) {
        const auto box = [&](double more) {
          return Box::triclinic({10 + a * more, 0, 0}, {b, 10, 0}, {c, 0, 10});
        };
        EXPECT_FALSE(verlet.is_stale(points, box(1 - 1e-8)));
        EXPECT_TRUE(verlet.is_stale(points, box(1 + 1e-8)));
      }
    }
  }
}

TEST(VerletList, StrainIsThatOfTheReducedCell) {
  // The long vectors of a skewed cell change by four times what the lattice's short ones do.
  const auto skewed = [](double a) { return Box::triclinic({a, 0, 0}, {4 * a, 10, 0}, {0, 0, 10}); };
  const std::vector<Vec3> points{{1, 1, 1}, {9, 9, 9}};
  auto verlet = verlet_list(2, 0.5);
  verlet.update(points, skewed(10));
  EXPECT_FALSE(verlet.is_stale(points, skewed(10.5 - 1e-9)));
  EXPECT_TRUE(verlet.is_stale(points, skewed(10.5 + 1e-9)));
}

TEST(VerletList, WhatIsAlwaysStaleAndWhatNever) {
  const std::vector<Vec3> points{{1, 1, 1}, {9, 9, 9}};
  auto verlet = verlet_list(2, 0.5);
  verlet.update(points, Box::orthorhombic({10, 10, 10}, {true, true, false}));
  EXPECT_TRUE(verlet.is_stale(points, Box::orthorhombic({10, 10, 10})));
  EXPECT_TRUE(verlet.is_stale(points, Box::none()));
  EXPECT_TRUE(
      verlet.is_stale(std::vector<Vec3>{{1, 1, 1}}, Box::orthorhombic({10, 10, 10}, {true, true, false})));
  EXPECT_FALSE(verlet.is_stale(points, Box::orthorhombic({10, 10, 77}, {true, true, false}, {3, 2, 1})))
      << "open axes and the origin move no pair";
  EXPECT_TRUE(verlet.is_stale(std::vector<Vec3>{{1, 1, 1}, {9, 9, std::numeric_limits<double>::quiet_NaN()}},
                              Box::orthorhombic({10, 10, 10}, {true, true, false})));
}

TEST(VerletList, StaleAfterAThrow) {
  const std::vector<Vec3> points{{1, 1, 1}, {9, 9, 9}};
  const std::vector<Vec3> nan{{1, 1, std::numeric_limits<double>::quiet_NaN()}, {9, 9, 9}};
  auto verlet = verlet_list(2, 0.5);
  verlet.update(points, Box::none());
  EXPECT_THROW(verlet.update(nan, Box::none()), InvalidPosition);
  EXPECT_TRUE(verlet.is_stale(points, Box::none()));
  EXPECT_THROW(verlet.update(points, Box::orthorhombic({4, 4, 4})), CutoffTooLarge);
  EXPECT_TRUE(verlet.update(points, Box::none()));
}

TEST(VerletList, BadParametersAreRefused) {
  EXPECT_THROW(VerletList(nullptr, with_skin(1, 0)), InvalidParameter);
  EXPECT_THROW(VerletList(make_cell_search(1), with_skin(1, -0.1)), InvalidParameter);
  EXPECT_THROW(VerletList(make_cell_search(1), with_skin(1, std::numeric_limits<double>::infinity())),
               InvalidParameter);
  VerletList too_large(make_cell_search(1), with_skin(1, 0.1));
  EXPECT_THROW(too_large.update({}, Box::none()), InvalidParameter);
}

/// The cell with every component changed by up to `largest`.
Box strained(const Box& box, double largest, scenes::Random& random) {
  const Box::Periodic periodic{box.periodic(0), box.periodic(1), box.periodic(2)};
  // Strain the lattice, not the long vectors of a skewed cell.
  const Vec3 shift[3] = {random.in_cube(largest), random.in_cube(largest), random.in_cube(largest)};
  Vec3 cell[3];
  for (int axis = 0; axis < 3; ++axis) {
    cell[axis] = box.vector(axis);
    for (int k = 0; k < box.rank(); ++k) {
      cell[axis] = cell[axis] + std::nearbyint(dot(box.reduced_dual()[k], box.vector(axis))) * shift[k];
    }
  }
  return Box::triclinic(cell[0], cell[1], cell[2], periodic, box.origin());
}

// Motion and strain of any size: as long as the list says that it is good, it holds every pair.
TEST(StaleTest, RemembersOnePlaceUntilItForgets) {
  const Box box = Box::orthorhombic({10, 10, 10});
  const std::vector<Vec3> points{{1, 1, 1}, {9, 9, 9}}, near{{1.2, 1, 1}, {9, 9, 9}},
      far{{1.3, 1, 1}, {9, 9, 9}};
  StaleTest test(0.5);
  EXPECT_TRUE(test.is_stale(points, box)) << "nothing remembered";
  test.remember(points, box);
  EXPECT_FALSE(test.is_stale(points, box));
  EXPECT_FALSE(test.is_stale(near, box));
  EXPECT_TRUE(test.is_stale(far, box));
  test.remember(far, box);
  EXPECT_FALSE(test.is_stale(near, box));
  test.forget();
  EXPECT_TRUE(test.is_stale(far, box));
  test.remember({}, box);
  EXPECT_FALSE(test.is_stale({}, box));
  EXPECT_THROW(StaleTest(-1), InvalidParameter);
  EXPECT_THROW(StaleTest{std::numeric_limits<double>::quiet_NaN()}, InvalidParameter);
}

// Whichever axes they are, and whatever box was remembered before.
TEST(StaleTest, OpenAxesAreLeftOut) {
  const std::vector<Vec3> points{{1, 1, 1}, {9, 9, 9}};
  for (int open = 0; open < 3; ++open) {
    const auto box_of = [&](double along, double across) {
      Vec3 lengths{across, across, across};
      lengths[open] = along;
      return Box::orthorhombic(lengths, {open != 0, open != 1, open != 2});
    };
    StaleTest test(0.5);
    test.remember(points, Box::orthorhombic({10, 10, 10}));
    test.remember(points, box_of(10, 10));
    EXPECT_FALSE(test.is_stale(points, box_of(77, 10))) << open;
    EXPECT_FALSE(test.is_stale(points, box_of(10, 10.3))) << open;
    EXPECT_TRUE(test.is_stale(points, box_of(10, 10.4))) << open << ", by 0.4 sqrt(2)";
  }
}

TEST(VerletList, NeverMissesAPairBetweenRebuilds) {
  const double cutoff = 1.2, skin = 0.5;
  for (const auto& [name, box] : scenes::all_boxes(5)) {
    scenes::Random random(17);
    int fresh = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const auto points = scenes::uniform_in(box, 80, 1000 + static_cast<std::uint64_t>(trial));
      auto verlet = verlet_list(cutoff, skin);
      verlet.update(points, box);
      const double strain = box.any_periodic() ? random.uniform(0, 0.2) : 0;
      const Box now = strain > 0 ? strained(box, strain, random) : box;
      const double step = random.uniform(0, 0.5 * skin);
      auto moved = points;
      for (Vec3& p : moved) {
        // With the box or not, to another image or not.
        p = p + random.in_ball(step);
        if (now.any_periodic()) p = p + std::nearbyint(random.uniform(-3, 3)) * now.reduced()[0];
      }
      if (now.max_cutoff() < cutoff || verlet.is_stale(moved, now)) continue;
      ++fresh;
      ASSERT_EQ(missing_pair(verlet, moved, now, cutoff), "") << name << ", trial " << trial;
    }
    EXPECT_GT(fresh, 30) << name << ": the test says little if nearly all lists are stale";
  }
}

// The worst motion: every pair just outside the list heads straight for each other.
TEST(VerletList, NeverMissesAPairThatClosesInHeadOn) {
  const double cutoff = 1.2, skin = 0.5;
  for (const auto& [name, box] : scenes::all_boxes(5)) {
    scenes::Random random(18);
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3 p = random.in_cube(20);
      const Vec3 outward = random.in_ball(1);
      const Vec3 unit = (1 / std::sqrt(norm2(outward))) * outward;
      const std::vector<Vec3> start{p, p + (cutoff + skin + 1e-9) * unit};
      auto verlet = verlet_list(cutoff, skin);
      verlet.update(start, box);
      ASSERT_EQ(verlet.list().pairs(), 0);
      const std::vector<Vec3> still_good{start[0] + (0.5 * skin - 1e-9) * unit,
                                         start[1] - (0.5 * skin - 1e-9) * unit};
      ASSERT_FALSE(verlet.is_stale(still_good, box)) << name;
      ASSERT_EQ(all_pairs(still_good, box, with_skin(cutoff, 0)).pairs(), 0) << name;
      const std::vector<Vec3> in_reach{start[0] + (0.5 * skin + 1e-9) * unit,
                                       start[1] - (0.5 * skin + 1e-9) * unit};
      ASSERT_EQ(all_pairs(in_reach, box, with_skin(cutoff, 0)).pairs(), 1) << name;
      ASSERT_TRUE(verlet.is_stale(in_reach, box)) << name;
    }
  }
}

/// A pair of points some images of the box away, just outside the list, and where it has come within the
/// cutoff.
struct ClosingPair {
  std::vector<Vec3> before, after;
};

/// How many images of the box away points are at most, before and after.
struct Images {
  double before, after;
};

/// @param step the motion of each point, along the line that joins their nearest images [length]
ClosingPair closing_pair(const Box& box, Images images, double cutoff, double step, scenes::Random& random) {
  const auto image = [&](double most) {
    Vec3 shift;
    for (int k = 0; k < box.rank(); ++k)
      shift = shift + std::nearbyint(random.uniform(-most, most)) * box.reduced()[k];
    return shift;
  };
  const Vec3 p = box.origin() + random.in_cube(5), outward = random.in_ball(1);
  const Vec3 unit = (1 / std::sqrt(norm2(outward))) * outward;
  const Vec3 q = p + (cutoff + random.uniform(1.6, 2) * step) * unit;
  if (images.before == images.after) {
    const Vec3 far_p = p + image(images.before), far_q = q + image(images.before);
    return {{far_p, far_q}, {far_p + step * unit, far_q - step * unit}};
  }
  return {{p + image(images.before), q + image(images.before)},
          {p + step * unit + image(images.after), q - step * unit + image(images.after)}};
}

void expect_no_pair_missed(const Box& box, Images images, scenes::Random& random) {
  const double cutoff = 1.2;
  // About the spacing of coordinates.
  const double unit = 1e-16 * (10 * std::max(images.before, images.after) + std::abs(box.origin().x));
  for (int trial = 0; trial < 500; ++trial) {
    const double step = random.uniform(1, 5) * unit, skin = random.uniform(1.4, 2.2) * step;
    const ClosingPair pair = closing_pair(box, images, cutoff, step, random);
    auto verlet = verlet_list(cutoff, skin);
    verlet.update(pair.before, box);
    if (verlet.is_stale(pair.after, box)) continue;
    ASSERT_EQ(missing_pair(verlet, pair.after, box, cutoff), "")
        << images.before << " boxes away, then " << images.after << ", corner at " << box.origin().x
        << ", trial " << trial;
  }
}

// Where coordinates are so large that displacements round, what cannot be told is stale.
TEST(VerletList, NeverMissesAPairFarAwayWhereDisplacementsRound) {
  scenes::Random random(19);
  for (const double away : {1.0, 1e9, 1e11, 1e12, 3e12}) {
    for (const double corner : {0.0, 1e9, 1e12}) {
      for (const Images images : {Images{away, away}, Images{away, 1}, Images{1, away}}) {
        const Vec3 origin{corner, -corner, corner};
        const Vec3 a{10.1, 0, 0}, b{3.1, 9.3, 0}, c{-2.3, 4.7, 11.7};
        expect_no_pair_missed(Box::orthorhombic({10.1, 9.3, 11.7}, {true, true, true}, origin), images,
                              random);
        expect_no_pair_missed(Box::orthorhombic({10.1, 9.3, 11.7}, {true, true, false}, origin), images,
                              random);
        expect_no_pair_missed(Box::triclinic(a, b, c, {true, true, true}, origin), images, random);
        if (HasFatalFailure()) return;
      }
    }
  }
}

// What rounding takes from the skin is little: far from the origin lists are kept as long as elsewhere.
TEST(VerletList, IsKeptFarAwayWhereRoundingIsLittleBesideTheSkin) {
  for (const double images : {1.0, 1e6, 1e9}) {
    const Box box = Box::orthorhombic({10, 10, 10}, {true, true, true}, {0, 0, 1e5});
    const Vec3 shift{-10 * images, 10 * images, 20 * images};
    std::vector<Vec3> points{Vec3{1, 1, 1} + shift, {9, 9, 9}};
    auto verlet = verlet_list(2, 0.5);
    verlet.update(points, box);
    EXPECT_FALSE(verlet.is_stale(points, box)) << images;
    points[0].x += 0.245;
    points[1] = points[1] + shift;
    EXPECT_FALSE(verlet.is_stale(points, box)) << images;
    points[0].x += 0.01;
    EXPECT_TRUE(verlet.is_stale(points, box)) << images;
  }
}

}  // namespace
}  // namespace dch
