// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/lists/all_pairs.hpp>

#include "list_compare.hpp"
#include "list_params.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

/// Sites of a simple cubic lattice of spacing 1, `side` along each axis.
std::vector<Vec3> cubic_sites(int side) {
  std::vector<Vec3> sites;
  for (int k = 0; k < side * side * side; ++k) {
    sites.push_back({double(k % side), double(k / side % side), double(k / side / side)});
  }
  return sites;
}

/// Pairs by looking at every image up to `reach` cells away.
std::int64_t count_images(const std::vector<Vec3>& points, const Box& box, double cutoff, int reach) {
  const auto range = [&](int axis) { return box.periodic(axis) ? reach : 0; };
  std::int64_t pairs = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      bool near = false;
      for (int a = -range(0); a <= range(0); ++a) {
        for (int b = -range(1); b <= range(1); ++b) {
          for (int c = -range(2); c <= range(2); ++c) {
            const Vec3 image =
                points[j] + double(a) * box.vector(0) + double(b) * box.vector(1) + double(c) * box.vector(2);
            near = near || norm2(image - points[i]) <= cutoff * cutoff;
          }
        }
      }
      pairs += near;
    }
  }
  return pairs;
}

TEST(AllPairs, ShellsOfTheSimpleCubicLattice) {
  const struct {
    double cutoff;
    int neighbors;
  } shells[] = {{0.9, 0}, {1, 6},   {std::sqrt(2.0) + 1e-9, 18}, {std::sqrt(3.0) + 1e-9, 26},
                {2, 32},  {2.5, 80}};
  const auto sites = cubic_sites(5);
  const Box box = Box::orthorhombic({5, 5, 5});
  // The same lattice in a skewed cell.
  const Box skewed = Box::triclinic({5, 0, 0}, {15, 5, 0}, {-10, 5, 5});
  for (const auto& [cutoff, neighbors] : shells) {
    for (const Box& b : {box, skewed}) {
      const auto list = all_pairs(sites, b, within(cutoff, ListKind::full));
      EXPECT_EQ(malformation(list, sites.size()), "");
      for (std::size_t i = 0; i < sites.size(); ++i)
        ASSERT_EQ(list.row(i).size(), std::size_t(neighbors)) << cutoff;
      EXPECT_EQ(all_pairs(sites, b, within(cutoff)).pairs(), 125 * neighbors / 2);
    }
  }
}

TEST(AllPairs, OpenAndPartlyPeriodicCubes) {
  const auto sites = cubic_sites(5);
  EXPECT_EQ(all_pairs(sites, Box::none(), within(1)).pairs(), 3 * 4 * 25);
  EXPECT_EQ(all_pairs(sites, Box::orthorhombic({5, 5, 5}, {true, false, false}), within(1)).pairs(),
            (5 + 4 + 4) * 25);
  EXPECT_EQ(all_pairs(sites, Box::orthorhombic({5, 5, 5}, {true, true, false}), within(1)).pairs(),
            (5 + 5 + 4) * 25);
  // A tilt of the open vector changes nothing.
  EXPECT_EQ(all_pairs(sites, Box::triclinic({5, 0, 0}, {0, 5, 0}, {2, 1, 5}, {true, true, false}), within(1))
                .pairs(),
            (5 + 5 + 4) * 25);
}

TEST(AllPairs, TwoImagesAtTheSameDistanceAreOnePair) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(all_pairs(points, Box::orthorhombic({2, 2, 2}), within(1)).pairs(), 1);
  EXPECT_EQ(all_pairs(points, Box::orthorhombic({2, 2, 2}), within(1, ListKind::full)).j,
            (std::vector<std::int32_t>{1, 0}));
}

TEST(AllPairs, EqualsACountOverAllImages) {
  for (const auto& [name, box] : scenes::all_boxes(5)) {
    auto points = scenes::uniform_in(box, 40, 5);
    for (const double cutoff : {0.7, 1.9}) {
      const double reach = std::min(cutoff, box.max_cutoff());
      EXPECT_EQ(all_pairs(points, box, within(reach)).pairs(), count_images(points, box, reach, 15)) << name;
    }
  }
}

TEST(AllPairs, WhereThePointsLieDoesNotMatter) {
  scenes::Random random(6);
  for (const auto& [name, box] : scenes::all_boxes(5)) {
    const auto points = scenes::uniform_in(box, 100, 7);
    auto moved = points;
    for (Vec3& p : moved) {
      for (int axis = 0; axis < 3; ++axis) {
        if (box.periodic(axis)) p = p + std::nearbyint(random.uniform(-1000, 1000)) * box.vector(axis);
      }
    }
    EXPECT_EQ(first_difference(all_pairs(moved, box, within(1.5)), all_pairs(points, box, within(1.5))), "")
        << name;
  }
}

TEST(AllPairs, CutoffAndSkinAreAddedBeforeSquaring) {
  const std::vector<Vec3> points{{0, 0, 0}, {0.3, 0, 0}};
  ListParams params = within(0.1);
  params.skin = 0.2;
  ASSERT_GT(0.1 + 0.2, 0.3) << "in doubles";
  EXPECT_EQ(all_pairs(points, Box::none(), params).pairs(), 1);
  EXPECT_EQ(all_pairs(points, Box::none(), within(0.3)).pairs(), 1);
  EXPECT_EQ(all_pairs(points, Box::none(), within(std::nextafter(0.3, 0.0))).pairs(), 0);
}

TEST(AllPairs, TypesExclusionsAndGhosts) {
  // Four on a line, 1 apart.
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  using Row = std::vector<std::int32_t>;

  const Row types{0, 0, 1, 1};
  ListParams typed = within(1);
  typed.cutoffs = TypeCutoffs(2, {1, 2, 2, 0});
  typed.skin = 0.5;  // not added to the cutoff of 0
  typed.types = types;
  auto list = all_pairs(points, Box::none(), typed);
  EXPECT_EQ(list.j, (Row{1, 2, 2, 3})) << "0-1, 0-2, 1-2, 1-3, but not 2-3";

  const auto exclusions = Exclusions::from_pairs(4, std::vector<IndexPair>{{2, 1}});
  ListParams excluding = within(1);
  excluding.exclusions = &exclusions;
  EXPECT_EQ(all_pairs(points, Box::none(), excluding).j, (Row{1, 3}));

  ListParams ghosts = within(1, ListKind::full);
  ghosts.first_ghost = 2;
  list = all_pairs(points, Box::none(), ghosts);
  EXPECT_EQ(list.first, (std::vector<std::int64_t>{0, 1, 3, 3, 3}));
  EXPECT_EQ(list.j, (Row{1, 0, 2}));
  EXPECT_EQ(list.pairs(), 2);
  ghosts.kind = ListKind::half;
  EXPECT_EQ(all_pairs(points, Box::none(), ghosts).j, (Row{1, 2}));
}

TEST(AllPairs, OneRowIsThatOfTheFullList) {
  for (const auto& [name, box] : scenes::all_boxes(5)) {
    const auto points = scenes::uniform_in(box, 60, 8);
    ListParams params = within(1.5, ListKind::full);
    params.first_ghost = 50;
    const auto list = all_pairs(points, box, params);
    for (std::int32_t i = 0; i < 60; ++i) {
      const auto row = list.row(std::size_t(i));
      ASSERT_EQ(all_neighbors(i, points, box, params), std::vector<std::int32_t>(row.begin(), row.end()))
          << name;
    }
  }
}

TEST(AllPairs, NoneAndOne) {
  EXPECT_EQ(all_pairs({}, Box::none(), within(1)).size(), 0u);
  const std::vector<Vec3> one{{1, 2, 3}};
  const auto list = all_pairs(one, Box::orthorhombic({2, 2, 2}), within(1, ListKind::full));
  EXPECT_EQ(list.size(), 1u);
  EXPECT_EQ(list.pairs(), 0);
}

TEST(AllPairs, BadInputIsRefused) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}};
  const std::vector<Vec3> nan{{0, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  EXPECT_THROW(all_pairs(nan, Box::none(), within(1)), InvalidPosition);
  EXPECT_THROW(all_pairs(points, Box::orthorhombic({2, 2, 2}), within(1.01)), CutoffTooLarge);
  ListParams negative = within(1);
  negative.skin = -1;
  EXPECT_THROW(all_pairs(points, Box::none(), negative), InvalidParameter);
  EXPECT_THROW(all_neighbors(2, points, Box::none(), within(1)), InvalidParameter);
  EXPECT_THROW(all_neighbors(-1, points, Box::none(), within(1)), InvalidParameter);
}

}  // namespace
}  // namespace dch
