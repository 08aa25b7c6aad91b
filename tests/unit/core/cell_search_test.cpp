// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "list_compare.hpp"
#include "list_params.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

void expect_oracle(PairSearch& search, const std::vector<Vec3>& points, const Box& box,
                   const ListParams& params, const std::string& scene) {
  search.update(points, box);
  const NeighborList list = search.list(params);
  ASSERT_EQ(malformation(list, points.size()), "") << scene;
  ASSERT_EQ(first_difference(list, all_pairs(points, box, params)), "") << scene;
}

/// Every engine on cells, the plain one with wide cells first.
std::vector<std::unique_ptr<PairSearch>> engines_for(double radius) {
  std::vector<std::unique_ptr<PairSearch>> all;
  for (const int divisions : {1, 2, 4}) all.push_back(make_cell_search(radius, divisions));
  all.push_back(make_grid_search(radius));
  return all;
}

class CellSearch : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(CellSearch, EqualsTheOracleInEveryScene) {
  const Box box = GetParam().box;
  for (const auto& search : engines_for(0.9)) {
    for (const std::size_t n : {0u, 1u, 2u, 50u, 400u}) {
      for (const auto& [name, points] : scenes::hard_point_sets(box, n, 0.45)) {
        const std::string scene = name + ", n = " + std::to_string(n) + ", " + search->name();
        ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, box, within(0.9), scene));
      }
    }
  }
}

// From many cells along each axis down to one, where cells meet each other on both sides.
TEST_P(CellSearch, EqualsTheOracleAtEveryShareOfTheBox) {
  const Box box = GetParam().box;
  const double largest = std::min(2.5, box.max_cutoff());
  const auto points = scenes::boundary(box, 300, 4);
  for (const double share : {0.1, 0.3, 0.45, 0.6, 0.7, 0.9, 1 - 1e-15, 1.0}) {
    for (const auto& search : engines_for(share * largest)) {
      ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, box, within(share * largest),
                                            search->name() + std::to_string(share)));
    }
  }
}

TEST_P(CellSearch, TypesExclusionsGhostsHalfAndFull) {
  const Box box = GetParam().box;
  const std::size_t n = 300;
  const auto points = scenes::clustered(box, n, 9);
  std::vector<std::int32_t> types(n);
  std::vector<IndexPair> bonds;
  for (std::size_t i = 0; i < n; ++i) {
    types[i] = static_cast<std::int32_t>(i % 3);
    if (i % 10 != 0) bonds.push_back({static_cast<std::int32_t>(i - 1), static_cast<std::int32_t>(i)});
  }
  const auto exclusions = Exclusions::from_bonds(n, bonds, 3);
  for (const auto& search : engines_for(1.5)) {
    for (const ListKind kind : {ListKind::half, ListKind::full}) {
      for (const std::int32_t first_ghost : {-1, 0, 200, 300}) {
        ListParams params = within(1, kind);
        params.first_ghost = first_ghost;
        ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, box, params, search->name() + ", ghosts"));
        params.cutoffs = TypeCutoffs(3, {0, 0.6, 1.25, 0.6, 0.8, 0.3, 1.25, 0.3, 1});
        params.skin = 0.25;
        params.types = types;
        ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, box, params, search->name() + ", types"));
        params.exclusions = &exclusions;
        ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, box, params, search->name() + ", exclusions"));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, CellSearch, ::testing::ValuesIn(scenes::all_boxes(5)),
                         [](const auto& p) { return p.param.name; });

TEST(CellSearchLarge, UniformFluid) {
  for (const Box& box :
       {Box::orthorhombic({18, 20, 19}), Box::triclinic({18, 0, 0}, {9, 18, 0}, {4, 7, 20})}) {
    const auto points = scenes::uniform_in(box, 5000, 11);
    for (const auto& search : engines_for(2.5)) {
      ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, box, within(2.5), box.description()));
    }
  }
}

TEST(CellSearchLarge, NeedsNoMemoryForEmptySpace) {
  scenes::Random random(12);
  std::vector<Vec3> points;
  for (int k = 0; k < 2000; ++k) points.push_back(Vec3{3e8, 4e8, 5e8} + random.in_ball(6));
  points.push_back({1e12, -1e12, 1e12});
  points.push_back({1e100, 0, 0});
  const std::vector<Vec3> droplet(points.begin(), points.begin() + 2000);
  for (const auto& search : engines_for(1)) {
    ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, Box::none(), within(1), "droplet in open space"));
    EXPECT_LT(search->stats().memory_bytes, 10u << 20);
    for (const double width : {1e5, 1e9}) {
      const Box box = Box::orthorhombic({width, width, width});
      ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, droplet, box, within(1), "droplet in a huge box"));
      EXPECT_LT(search->stats().memory_bytes, 10u << 20);
    }
  }
}

TEST(CellSearchLarge, PairsFarFromTheOthersAreFound) {
  auto points = scenes::uniform_in(Box::none(), 300, 13);
  for (const double x : {1e6, 1e9, 1e12, 1e15, 1e100}) {
    points.push_back({x, -x, 0.25});
    points.push_back({x, -x, 0.75});
  }
  const Box oblique = Box::triclinic({1, 1, 0}, {0, 0, 1}, {1, -1, 0}, {false, true, false});
  for (const Box& box : {Box::none(), Box::orthorhombic({5, 5, 5}, {false, false, true}), oblique}) {
    for (const auto& search : engines_for(0.5))
      ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, box, within(0.5), box.description()));
  }
}

TEST(CellSearchErrors, BadRadiusAndDivisions) {
  for (const double radius : {0.0, -1.0, 9e-101, std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(make_cell_search(radius), InvalidParameter) << radius;
    EXPECT_THROW(make_grid_search(radius), InvalidParameter) << radius;
  }
  EXPECT_THROW(make_cell_search(1, 0), InvalidParameter);
  EXPECT_THROW(make_cell_search(1, 5), InvalidParameter);
}

TEST(CellSearchErrors, HoldsNothingAfterAThrow) {
  const std::vector<Vec3> points{{0, 0, 0}, {0.5, 0, 0}};
  const std::vector<Vec3> nan{{0, 0, 0}, {0, std::numeric_limits<double>::quiet_NaN(), 0}};
  for (const auto& search : engines_for(1)) {
    const auto expect_empty_after = [&](auto&& bad_update) {
      search->update(points, Box::none());
      ASSERT_EQ(search->list(within(1)).pairs(), 1);
      bad_update();
      EXPECT_EQ(search->list(within(1)).size(), 0u);
    };
    expect_empty_after([&] { EXPECT_THROW(search->update(nan, Box::none()), InvalidPosition); });
    expect_empty_after([&] {
      EXPECT_THROW(search->update(points, Box::orthorhombic({1.9, 4, 4})), CutoffTooLarge);
    });
    const std::vector<std::uint64_t> repeated{7, 7}, few{7};
    expect_empty_after(
        [&] { EXPECT_THROW(search->update(points, Box::none(), repeated), InvalidParameter); });
    expect_empty_after([&] { EXPECT_THROW(search->update(points, Box::none(), few), InvalidParameter); });
  }
}

TEST(CellSearchErrors, ListsBeyondTheRadiusAreRefused) {
  for (const auto& search : engines_for(1)) {
    EXPECT_EQ(search->list(within(1)).size(), 0u) << "before the first update";
    EXPECT_THROW(search->list(within(1.001)), InvalidParameter);
  }
}

TEST(CellSearchStats, CountsAndKeys) {
  const std::vector<Vec3> points{{0, 0, 0}, {0.5, 0, 0}};
  const std::vector<std::uint64_t> keys{12, 5};
  const auto search = make_cell_search(1);
  EXPECT_EQ(search->name(), "cell");
  search->update(points, Box::none(), keys);
  search->update(points, Box::none());
  EXPECT_EQ(search->stats().updates, 2);
  EXPECT_EQ(search->stats().builds, 2);
  EXPECT_EQ(search->stats().repairs, 0);
  EXPECT_GT(search->stats().memory_bytes, 0u);
}

// Cells are made when a list tells how wide they should be, and once for the same list.
TEST(GridSearchStats, CountsAndKeys) {
  const std::vector<Vec3> points{{0, 0, 0}, {0.5, 0, 0}};
  const std::vector<std::uint64_t> keys{12, 5};
  const auto search = make_grid_search(1);
  EXPECT_EQ(search->name(), "grid");
  EXPECT_FALSE(search->has_cluster_pairs());
  search->update(points, Box::none(), keys);
  search->update(points, Box::none());
  EXPECT_EQ(search->stats().updates, 2);
  EXPECT_EQ(search->stats().builds, 0);
  for (int k = 0; k < 2; ++k) EXPECT_EQ(search->list(within(1)).pairs(), 1);
  EXPECT_EQ(search->stats().builds, 1);
  EXPECT_EQ(search->list(within(0.5)).pairs(), 1);
  EXPECT_EQ(search->stats().builds, 2);
  EXPECT_GT(search->stats().memory_bytes, 0u);
}

}  // namespace
}  // namespace dch
