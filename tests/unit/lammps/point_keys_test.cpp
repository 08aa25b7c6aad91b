// SPDX-License-Identifier: GPL-2.0-or-later
#include "point_keys.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <vector>

namespace dch::lammps {
namespace {

// Orthorhombic box [low, low + edge) with all axes periodic.
Lattice cube(double edge, Vec3 low = {}) {
  Lattice lattice;
  lattice.inverse = {1 / edge, 1 / edge, 1 / edge, 0, 0, 0};
  lattice.periodic = {true, true, true};
  lattice.low = low;
  return lattice;
}

struct Atoms {
  std::vector<Vec3> points;
  std::vector<std::int64_t> tags;
  std::vector<ImageFlags> images;
};

std::vector<std::uint64_t> keys_of(const Atoms& atoms, const Lattice& lattice) {
  PointKeys maker;
  const auto keys = maker.assign(atoms.points, atoms.tags, atoms.images, lattice);
  return {keys.begin(), keys.end()};
}

TEST(PointKeys, CopiesOfAnAtomHaveDifferentNames) {
  Atoms atoms{{}, {}, {{0, 0, 0}}};
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      for (int c = 0; c < 3; ++c) {
        atoms.points.push_back({1 + 5.0 * a, 2 + 5.0 * b, 3 + 5.0 * c});
        atoms.tags.push_back(7);
      }
    }
  }
  const auto keys = keys_of(atoms, cube(5));
  EXPECT_EQ(std::set<std::uint64_t>(keys.begin(), keys.end()).size(), 27u);
}

// An atom exactly on the face, and its image an ulp short of a whole box away: counting box vectors by the
// floor of each point's own coordinates would give both the same name.
TEST(PointKeys, RoundingAtAFaceDoesNotMakeNamesEqual) {
  const double low = -13.7, edge = 9.1;
  const double image = std::nextafter(low + edge, 0.0);
  for (const bool owned : {true, false}) {
    Atoms atoms{{{low, 0, 0}, {image, 0, 0}}, {3, 3}, {}};
    if (owned) atoms.images = {{0, 0, 0}};
    const auto keys = keys_of(atoms, cube(edge, {low, low, low}));
    ASSERT_EQ(keys.size(), 2u);
    EXPECT_NE(keys[0], keys[1]) << (owned ? "owned" : "ghosts of another process");
  }
}

TEST(PointKeys, NamesSurviveReSorting) {
  const Atoms before{{{1, 1, 1}, {2, 2, 2}, {6, 1, 1}}, {10, 20, 10}, {{0, 0, 0}, {0, 1, 0}}};
  const Atoms after{{{2, 2, 2}, {1, 1, 1}, {6, 1, 1}}, {20, 10, 10}, {{0, 1, 0}, {0, 0, 0}}};
  const auto a = keys_of(before, cube(5)), b = keys_of(after, cube(5));
  EXPECT_EQ(a[0], b[1]);
  EXPECT_EQ(a[1], b[0]);
  EXPECT_EQ(a[2], b[2]);
}

// The atom leaves through the upper face: the owned copy goes on as the ghost beyond that face, and the ghost
// beyond the lower face becomes the owned copy.
TEST(PointKeys, NamesFollowThePointWhenAnAtomCrossesTheBox) {
  const Atoms before{{{4.9, 1, 1}, {-0.1, 1, 1}}, {5, 5}, {{0, 0, 0}}};
  const Atoms after{{{0.1, 1, 1}, {5.1, 1, 1}}, {5, 5}, {{1, 0, 0}}};
  const auto a = keys_of(before, cube(5)), b = keys_of(after, cube(5));
  EXPECT_EQ(a[0], b[1]);
  EXPECT_EQ(a[1], b[0]);
}

TEST(PointKeys, TiltedBoxesAreCountedAlongTheirVectors) {
  Lattice lattice;  // vectors (4,0,0), (1,5,0), (-1,2,6)
  lattice.inverse = {1.0 / 4, 1.0 / 5, 1.0 / 6, -2.0 / (5 * 6), 7.0 / (4 * 5 * 6), -1.0 / (4 * 5)};
  lattice.periodic = {true, true, true};
  Atoms atoms{{{0.5, 0.5, 0.5}}, {1}, {{0, 0, 0}}};
  for (const Vec3 shift : {Vec3{4, 0, 0}, Vec3{1, 5, 0}, Vec3{-1, 2, 6}, Vec3{4, 7, 6}}) {
    atoms.points.push_back(atoms.points[0] + shift);
    atoms.tags.push_back(1);
  }
  const auto keys = keys_of(atoms, lattice);
  const auto code = [](int a, int b, int c) {
    return 1ull << 24 | (a & 255ull) << 16 | (b & 255ull) << 8 | (c & 255ull);
  };
  EXPECT_EQ(keys, (std::vector<std::uint64_t>{code(0, 0, 0), code(-1, 0, 0), code(0, -1, 0), code(0, 0, -1),
                                              code(-1, -1, -1)}));
}

TEST(PointKeys, ImagesTooFarApartHaveNoNames) {
  const Atoms atoms{{{0.5, 0.5, 0.5}, {200.5, 0.5, 0.5}}, {1, 1}, {{0, 0, 0}}};
  EXPECT_TRUE(keys_of(atoms, cube(1)).empty());
  EXPECT_EQ(keys_of(atoms, cube(100)).size(), 2u);
}

TEST(PointKeys, IdsTooLongHaveNoNames) {
  constexpr std::int64_t first = std::int64_t{1} << 40;
  for (const std::int64_t longest : {first, first + 1, std::numeric_limits<std::int64_t>::max()})
    EXPECT_TRUE(keys_of({{{1, 1, 1}, {2, 1, 1}}, {1, longest}, {{0, 0, 0}, {0, 0, 0}}}, cube(5)).empty());
  const auto keys = keys_of({{{1, 1, 1}, {2, 1, 1}}, {first - 1, 1}, {{0, 0, 0}, {0, 0, 0}}}, cube(5));
  EXPECT_EQ(keys, (std::vector<std::uint64_t>{((1ull << 40) - 1) << 24, 1ull << 24}));
}

TEST(PointKeys, NoPointsAndNonNumericOnes) {
  EXPECT_TRUE(keys_of({}, cube(5)).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(keys_of({{{1, 1, 1}, {nan, 1, 1}}, {1, 1}, {{0, 0, 0}}}, cube(5)).empty());
}

}  // namespace
}  // namespace dch::lammps
