// SPDX-License-Identifier: MIT
//
// What lists cost for each of their pairs: boxes of blocks that are compared, points that are gathered, pairs
// that are tested. Constants are a tenth or less above what was counted; the counts are the same everywhere.
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

#include "hierarchy/structure.hpp"
#include "listed_hierarchy.hpp"
#include "lists/leaf_rows.hpp"
#include "lists/list_finder.hpp"
#include "lists/reach.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

struct WorkOfPair {
  WorkOfPair(const ListWork& work, const NeighborList& list) {
    const auto pairs = static_cast<double>(list.pairs());
    nodes = static_cast<double>(work.nodes) / pairs;
    boxes = static_cast<double>(work.boxes) / pairs;
    gathered = static_cast<double>(work.gathered) / pairs;
    tested = static_cast<double>(work.tested) / pairs;
  }
  double nodes, boxes, gathered, tested;
};

WorkOfPair work_of(const std::vector<Vec3>& points, const Box& box, const ListParams& request,
                   double radius) {
  StructureParams params;
  params.radius = radius;
  ListedHierarchy h(params);
  h.build(points, box);
  NeighborList list;
  h.list(request, list);
  return {h.list_maker().work(), list};
}

// Candidates of a pair, at ten points in the unit of volume: as many for few points as for many, whatever
// cutoffs go by.
TEST(Work, OfListsGrowsWithTheirPairsAlone) {
  for (const std::size_t n : {4000u, 32000u}) {
    const double side = std::cbrt(0.1 * static_cast<double>(n));
    const Box box = Box::orthorhombic({side, side, side});
    const std::vector<Vec3> points = scenes::uniform_in(box, n, 4);
    const std::vector<double> radii(n, 0.5);
    const std::vector<std::int32_t> types(n, 1);
    ListParams one_cutoff, by_radii, by_types;
    by_radii.radii = radii;
    by_types.types = types;
    by_types.cutoffs = TypeCutoffs(2, {0.5, 1, 1, 1});
    for (const ListParams& request : {one_cutoff, by_radii, by_types}) {
      const WorkOfPair work = work_of(points, box, request, 1);
      EXPECT_EQ(work.nodes, 0);
      EXPECT_LE(work.boxes, 0.12) << n;
      EXPECT_LE(work.gathered, 0.41) << n;
      EXPECT_LE(work.tested, 4.7) << n;
    }
  }
}

/// Leaves much smaller than the reach, as edges of level 1 join them far beyond it: those that are too far
/// for any pair are left out before their blocks are looked at.
TEST(Work, OfListsWithAShorterReachThanTheirHierarchy) {
  for (const std::size_t n : {4000u, 32000u}) {
    const double side = std::cbrt(0.1 * static_cast<double>(n));
    const Box box = Box::orthorhombic({side, side, side});
    ListParams request;
    request.cutoffs = TypeCutoffs(0.5);
    EXPECT_LE(work_of(scenes::uniform_in(box, n, 4), box, request, 2).boxes, 0.65) << n;
  }
}

/// A hierarchy of some of the particles, with many leaves.
ListedHierarchy hierarchy_of_some(const std::vector<Vec3>& points, const Box& box, double radius) {
  StructureParams params;
  params.radius = radius;
  params.base_radius = radius;
  params.collapse_singletons = false;
  ListedHierarchy h(params);
  h.build(points, box);
  return h;
}

// Many small particles and few large ones with a hierarchy for either: for a leaf of large ones those of
// small ones near it are found by a descent, whose work is that of the levels and of the leaves that are
// near, however many others there are.
TEST(Work, OfListsBetweenHierarchiesGrowsWithTheirPairsAlone) {
  constexpr double kSmall = 0.25, kLarge = 1;
  for (const std::size_t n : {4000u, 32000u}) {
    const double side = std::cbrt(0.1 * static_cast<double>(n));
    const Box box = Box::orthorhombic({side, side, side});
    const std::vector<Vec3> points = scenes::uniform_in(box, n, 4);
    const std::size_t small = n - n / 50;
    std::vector<double> radii(n, kSmall);
    std::fill(radii.begin() + static_cast<std::ptrdiff_t>(small), radii.end(), kLarge);
    std::vector<std::int32_t> ids(n);
    std::iota(ids.begin(), ids.end(), 0);
    ListedHierarchy of_small = hierarchy_of_some(
        {points.begin(), points.begin() + static_cast<std::ptrdiff_t>(small)}, box, 2 * kSmall);
    ListedHierarchy of_large = hierarchy_of_some(
        {points.begin() + static_cast<std::ptrdiff_t>(small), points.end()}, box, 2 * kLarge);
    const detail::Structure &a = of_small.view().structure(), &b = of_large.view().structure();
    detail::LeafSource source_of_small{&a, {{ids.data(), small}, 1}, {}, {}};
    detail::LeafSource source_of_large{&b, {{ids.data() + small, n - small}, 1}, {}, {}};
    detail::LeafSource* const sources[] = {&source_of_small, &source_of_large};
    const double error = std::max(detail::distance_error(a), detail::distance_error(b));
    const detail::ListScene scene{
        box, {sources, 2}, {2 * kSmall, kSmall + kLarge, kSmall + kLarge, 2 * kLarge}, error, nullptr};
    ListParams request;
    request.radii = radii;
    NeighborList list;
    detail::LeafRows rows;
    detail::ListFinder finder;
    finder.find({points, box, error}, {&request, 1},
                [&](const auto& filters, const auto& lists) { rows.find(scene, filters, lists); }, {&list});
    const WorkOfPair work(rows.work(), list);
    EXPECT_LE(work.nodes, 2.4) << n;
    EXPECT_LE(work.boxes, 1.45) << n;
    EXPECT_LE(work.gathered, 4.8) << n;
    EXPECT_LE(work.tested, 9.8) << n;
  }
}

}  // namespace
}  // namespace dch
