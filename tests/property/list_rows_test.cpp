// SPDX-License-Identifier: MIT
//
// Rows where the kernels leave much open, or where differences of 16-bit coordinates come near their limits:
// the lists are the oracle's, and the same on every instruction set, entry by entry.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "instruction_sets.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

/// Expects the list of each request, on each instruction set, to be the oracle's, and all sets' the same.
void expect_lists(const std::vector<Vec3>& points, const Box& box, const StructureParams& structure,
                  std::vector<ListParams> requests, const std::string& what) {
  const RestoreInstructionSet restore;
  for (ListParams& request : requests) {
    request.order = RowOrder::by_index;
    const NeighborList expected = all_pairs(points, box, request);
    request.order = RowOrder::unsorted;
    NeighborList first;
    for (const InstructionSet set : supported_sets()) {
      set_instruction_set(set);
      const auto search = make_dch_search(structure);
      search->update(points, box);
      const NeighborList list = search->list(request);
      ASSERT_EQ(first_difference(sorted_by_index(list, points.size()), expected), "") << set << what;
      if (first.particle.empty()) first = list;
      ASSERT_EQ(list.first, first.first) << set << what;
      ASSERT_EQ(list.near_end, first.near_end) << set << what;
      ASSERT_TRUE(std::equal(first.j.begin(), first.j.begin() + first.first.back(), list.j.begin()))
          << set << what;
    }
  }
}

/// A cubic lattice of spacing 1, where distances are shaken by no more than the rounding of coordinates.
std::vector<Vec3> lattice_points(int side, double shake, scenes::Random& random) {
  std::vector<Vec3> points;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z)
        points.push_back(Vec3{x + 0.5, y + 0.5, z + 0.5} + random.in_cube(shake));
  return points;
}

// Each point has 6 to 24 others at the cutoff; about half are within it, and only doubles tell which.
TEST(ListRows, OfLatticesWhoseDistancesAreTheCutoff) {
  constexpr int kSide = 7;
  const Box box = Box::orthorhombic({kSide, kSide, kSide});
  for (const double shake : {0.0, 1e-15, 1e-12, 1e-5}) {
    SCOPED_TRACE("seed 11, shaken by " + std::to_string(shake));
    scenes::Random random(11);
    const std::vector<Vec3> points = lattice_points(kSide, shake, random);
    std::vector<IndexPair> bonds;
    for (std::int32_t i = 0; i + 1 < static_cast<std::int32_t>(points.size()); i += 3)
      bonds.push_back({i, i + 1});
    const Exclusions exclusions = Exclusions::from_bonds(points.size(), bonds, 1);
    std::vector<std::int32_t> types;
    std::vector<double> radii;
    for (std::size_t i = 0; i < points.size(); ++i) {
      types.push_back(static_cast<std::int32_t>(i % 3));
      radii.push_back(i % 2 == 0 ? 0.5 : std::sqrt(3.0) - 0.5);
    }
    StructureParams structure;
    std::vector<ListParams> requests;
    for (const double length2 : {1.0, 2.0, 3.0, 4.0, 5.0}) {
      ListParams request;
      request.cutoffs = TypeCutoffs(std::sqrt(length2));
      structure.radius = std::sqrt(length2);
      requests.push_back(request);
    }
    structure.radius = std::sqrt(3.0) * 2;
    ListParams shell = requests[2];
    shell.cutoffs = TypeCutoffs(1);
    shell.skin = shell.shell = std::sqrt(3.0) - 1;
    requests.push_back(shell);
    for (const std::size_t k : {std::size_t{2}, requests.size() - 1}) {
      requests.push_back(requests[k]);
      requests.back().exclusions = &exclusions;
      requests.push_back(requests[k]);
      requests.back().first_ghost = 200;
    }
    ListParams by_type;
    by_type.types = types;
    const double a = 1, b = std::sqrt(2.0), c = std::sqrt(3.0);
    by_type.cutoffs = TypeCutoffs(3, {a, b, 0, b, c, a, 0, a, b});
    requests.push_back(by_type);
    by_type.exclusions = &exclusions;
    requests.push_back(by_type);
    ListParams by_radius;
    by_radius.radii = radii;
    requests.push_back(by_radius);
    for (const ListParams& request : requests) {
      StructureParams own = structure;
      own.radius = request.list_radius();
      ASSERT_NO_FATAL_FAILURE(expect_lists(points, box, own, {request}, ""));
    }
  }
}

// Leaves many times as wide as the reach of lists, and blocks nearly as wide: what a filter and a test take
// from each other come close to what 16 bits hold.
TEST(ListRows, OfLeavesAndBlocksFarWiderThanTheCutoff) {
  scenes::Random random(12);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE("seed 12, trial " + std::to_string(trial));
    const double ratio = std::pow(10, random.uniform(0, 2)), side = random.uniform(4, 12) * ratio;
    const Box box = trial % 2 == 0 ? Box::none() : Box::orthorhombic({side, side, side});
    const std::size_t count = 30 + random.below(400);
    const Vec3 stretch{1, trial % 3 == 0 ? 0.01 : 1, trial % 3 == 1 ? 0.001 : 1};
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 at = random.in_cube(0.5 * side);
      points.push_back(
          {at.x * stretch.x + 0.5 * side, at.y * stretch.y + 0.5 * side, at.z * stretch.z + 0.5 * side});
      if (i % 2 == 1) points.back() = points[i - 1] + random.in_cube(0.6);  // or there might be no pairs
    }
    StructureParams structure;
    structure.radius = 1;
    structure.base_radius = ratio;
    ListParams large, small;
    large.cutoffs = TypeCutoffs(1);
    small.cutoffs = TypeCutoffs(random.uniform(0.01, 0.5));
    ASSERT_NO_FATAL_FAILURE(expect_lists(points, box, structure, {large, small}, ""));
  }
}

// After jumps across the whole box, also out of it and back; positions that are no numbers are refused, and
// the next list is right again.
TEST(ListRows, AfterFarJumpsAndRefusedPositions) {
  scenes::Random random(13);
  const Box box = Box::orthorhombic({12, 12, 12});
  std::vector<Vec3> points = lattice_points(12, 0.2, random);
  ListParams request;
  request.cutoffs = TypeCutoffs(1.6);
  const auto search = make_dch_search(1.6);
  for (int step = 0; step < 8; ++step) {
    for (int k = 0; k < 40; ++k)
      points[random.below(points.size())] = random.in_cube(step % 3 == 0 ? 40 : 12);
    search->update(points, box);
    ASSERT_EQ(first_difference(search->list(request), all_pairs(points, box, request)), "")
        << "step " << step;
    std::vector<Vec3> broken = points;
    const std::size_t at = random.below(points.size());
    broken[at].y = step % 2 == 0 ? std::nan("") : 1e300;
    try {
      search->update(broken, box);
      FAIL() << "took a position that is none";
    } catch (const InvalidPosition& error) {
      EXPECT_NE(std::string(error.what()).find("position " + std::to_string(at) + " "), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace dch
