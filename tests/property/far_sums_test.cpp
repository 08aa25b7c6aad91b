// SPDX-License-Identifier: MIT
//
// Far sums against sums over all pairs, in random scenes of all boxes: the error stays below what is proven
// of it, and that below the tolerance.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/far_sums.hpp>

#include "effort.hpp"
#include "error_message.hpp"
#include "far_sums_oracle.hpp"
#include "instruction_sets.hpp"
#include "liquid.hpp"
#include "proximity_checks.hpp"
#include "proximity_scene.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

/// Charges of one sign or both, some of them 0, of like or of very unlike sizes.
std::vector<double> random_charges(const PointTree& tree, scenes::Random& random) {
  const bool is_signed = random.below(2) == 0, has_zeros = random.below(3) == 0;
  const double decades = random.below(2) == 0 ? 0 : 6, size = std::pow(10, random.uniform(-20, 20));
  std::vector<double> charges(tree.capacity());
  for (double& charge : charges) {
    charge = size * std::pow(10, decades * random.uniform());
    if (is_signed && random.below(2) == 0) charge = -charge;
    if (has_zeros && random.below(3) == 0) charge = 0;
  }
  return charges;
}

struct Checked {
  int points = 0;
  double largest_share = 0;  ///< of an error in its bound
  int periodic = 0, with_far = 0, refused = 0;
};

/// Compares at some points. In periodic boxes wrapped positions are rounded, which points that almost
/// coincide feel; they are left out where that is more than 1e-4 of the tolerance.
void check_sums(const PointTree& tree, const std::vector<double>& charges, const FarSumParams& params,
                const FarSums& sums, int most, scenes::Random& random, const std::string& what,
                Checked& checked) {
  ASSERT_LE(sums.error_bound, params.tolerance) << what;
  const std::vector<std::int32_t> ids(tree.ids().begin(), tree.ids().end());
  for (int k = 0; k < most && tree.size() > 0; ++k) {
    const std::int32_t id = ids[random.below(ids.size())];
    const test::DirectSum expected = test::direct_sum(tree, charges, params.kappa, id);
    if (tree.rounding() > 1e-4 * params.tolerance * expected.nearest) continue;
    const double error = std::abs(sums.potentials[static_cast<std::size_t>(id)] - expected.potential);
    double largest = 0;  // exponentials beyond the range of numbers are not what they should be
    for (const double charge : charges) largest = std::max(largest, std::abs(charge));
    const double underflow = 1e-300 * largest / expected.nearest;
    const double rounding = 1e-12 + 10 * tree.rounding() * (1 / expected.nearest + params.kappa);
    ASSERT_LE(error, (sums.error_bound + rounding) * expected.of_absolute + underflow)
        << what << ", point " << id << ": " << expected.potential;
    ++checked.points;
    if (sums.error_bound > 0 && expected.of_absolute > 0)
      checked.largest_share =
          std::max(checked.largest_share, error / expected.of_absolute / sums.error_bound);
  }
}

/// Points of a slab or a rod may spread so far along its open axes that too many images count.
bool spreads_far(const PointTree& tree) {
  return tree.box().rank() < 3 && tree.node(0).radius > 3 * tree.box().shortest_period();
}

void check_scene(ProximityScene& scene, Checked& checked) {
  const PointTree tree(scene.view());
  const std::vector<double> charges = random_charges(tree, scene.random);
  FarSumParams params;
  params.tolerance = std::pow(10, scene.random.uniform(-8, -1));
  const bool is_periodic = scene.box().any_periodic();
  const double period = is_periodic ? scene.box().shortest_period() : 5;
  if (is_periodic || scene.random.below(2) == 0) params.kappa = scene.random.uniform(5, 30) / period;
  const std::string what = scene.what() + ", tolerance " + std::to_string(params.tolerance) + ", kappa " +
                           std::to_string(params.kappa);
  FarSums sums;
  try {
    sums = far_sums(tree, charges, params);
  } catch (const InvalidParameter& error) {
    ASSERT_TRUE(is_periodic && tree.size() > 0 && spreads_far(tree)) << what << ": " << error.what();
    ++checked.refused;
    return;
  }
  checked.periodic += is_periodic;
  checked.with_far += sums.far_pairs > 0;
  check_sums(tree, charges, params, sums, is_periodic ? 3 : 20, scene.random, what, checked);
}

TEST(FarSums, AreWithinTheToleranceInRandomScenes) {
  constexpr int kScenes = effort(100);
  Checked checked;
  // Fewer points in most scenes, since those in boxes have thousands of images each.
  for (int k = 0; k < kScenes; ++k) {
    ProximityScene scene(4100000 + static_cast<std::uint64_t>(k), k % 6 == 0 ? 900 : 250);
    for (int step = 0; step < 2; ++step, scene.change(step))
      ASSERT_NO_FATAL_FAILURE(check_scene(scene, checked)) << "step " << step;
  }
  EXPECT_GT(checked.periodic, kScenes / 2);
  EXPECT_GT(checked.with_far, kScenes / 4);
  EXPECT_LT(checked.refused, kScenes / 4);
  EXPECT_GT(checked.points, kScenes * 5);
  EXPECT_GT(checked.largest_share, 0.3);  // so the proven bound is none that could be much smaller
}

// Of points on a line the errors of all pairs of nodes can have the same sign, so that they add up.
TEST(FarSums, BoundIsNearlyReachedOnALine) {
  const Box open = Box::none();
  HierarchyParams hierarchy_params;
  hierarchy_params.radius = 1;
  Hierarchy hierarchy(hierarchy_params);
  hierarchy.build(scenes::collinear(open, 4000, 0.1, 1), open);
  const PointTree tree(hierarchy.view());
  const std::vector<double> charges(tree.capacity(), 1.0);
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    FarSumParams params;
    params.tolerance = tolerance;
    const FarSums sums = far_sums(tree, charges, params);
    EXPECT_GT(sums.far_pairs, 0);
    Checked checked;
    scenes::Random random(2);
    check_sums(tree, charges, params, sums, 400, random, "line", checked);
    EXPECT_GT(checked.largest_share, 0.01);
  }
}

/// At a tolerance of 1e-4.
FarSums of_liquid(int side, const Box& box, double kappa) {
  const PointTree tree(liquid(side, box).view());
  scenes::Random random(3);
  std::vector<double> charges(tree.capacity());
  for (double& charge : charges) charge = random.below(2) == 0 ? 1 : -1;
  FarSumParams params;
  params.kappa = kappa;
  return far_sums(tree, charges, params);
}

// If nodes were no longer taken as a whole, there would be as many near pairs a point as there are points.
TEST(FarSums, TakeWorkInProportionToPoints) {
  const FarSums small = of_liquid(24, Box::none(), 0), large = of_liquid(40, Box::none(), 0);
  const std::int64_t few = 24 * 24 * 24, many = 40 * 40 * 40;
  EXPECT_EQ(small.order, 7);
  EXPECT_LE(small.far_pairs, 6 * few);
  EXPECT_LE(small.near_pairs, 2200 * few);
  EXPECT_LE(small.looked_at, 18 * few);
  EXPECT_LE(large.far_pairs, 8 * many);
  EXPECT_LE(large.near_pairs, 3500 * many);
  EXPECT_LE(large.looked_at, 26 * many);
}

TEST(FarSums, LeaveOutImagesThatDoNotCount) {
  const std::int64_t n = 12 * 12 * 12;
  const FarSums near = of_liquid(12, Box::orthorhombic({12, 12, 12}), 3);
  EXPECT_LT(near.images, 600);
  EXPECT_LE(near.near_pairs, 4 * n * n);  // of each of 500 images there are n * n
  EXPECT_EQ(of_liquid(4, Box::none(), 3).images, 1);
}

TEST(FarSums, AreTheSameOnAnyNumberOfThreads) {
  const PointTree tree(liquid(16, Box::none()).view());
  scenes::Random random(4);
  const std::vector<double> charges = random_charges(tree, random);
  const FarSums expected = far_sums(tree, charges, {});
  EXPECT_GT(expected.far_pairs, 0);
  for (const int threads : {2, 3}) {
    const auto pool = make_thread_pool(threads);
    FarSumParams params;
    params.executor = pool.get();
    const FarSums sums = far_sums(tree, charges, params);
    EXPECT_EQ(sums.potentials, expected.potentials);
    EXPECT_EQ(sums.error_bound, expected.error_bound);
    EXPECT_EQ(sums.far_pairs, expected.far_pairs);
    EXPECT_EQ(sums.near_pairs, expected.near_pairs);
    EXPECT_EQ(sums.looked_at, expected.looked_at);
  }
}

TEST(FarSums, AreTheSameBesideRoundingWithAnyInstructionSet) {
  const RestoreInstructionSet restore;
  const PointTree tree(liquid(12, Box::none()).view());
  scenes::Random random(5);
  const std::vector<double> charges(tree.capacity(), 1.0);
  for (const double kappa : {0.0, 0.3}) {
    FarSumParams params;
    params.kappa = kappa;
    const FarSums expected = far_sums(tree, charges, params);
    for (const InstructionSet set : supported_sets()) {
      set_instruction_set(set);
      const FarSums sums = far_sums(tree, charges, params);
      EXPECT_EQ(sums.far_pairs, expected.far_pairs) << name(set);
      for (std::size_t k = 0; k < charges.size(); ++k)
        ASSERT_NEAR(sums.potentials[k], expected.potentials[k], 1e-13 * expected.potentials[k]) << name(set);
    }
  }
}

FarSums of_points(const std::vector<Vec3>& points, const std::vector<double>& charges,
                  const FarSumParams& params = {}, const Box& box = Box::none()) {
  HierarchyParams hierarchy_params;
  hierarchy_params.radius = 1;
  Hierarchy hierarchy(hierarchy_params);
  hierarchy.build(points, box);
  return far_sums(PointTree(hierarchy.view()), charges, params);
}

TEST(FarSums, OfFewPointsAreThoseOfThePairs) {
  EXPECT_TRUE(of_points({}, {}).potentials.empty());
  EXPECT_EQ(of_points({{1, 2, 3}}, {5}).potentials, std::vector<double>{0});
  const FarSums two = of_points({{1, 2, 3}, {1, 2, 7}}, {5, -3});
  EXPECT_DOUBLE_EQ(two.potentials[0], -0.75);
  EXPECT_DOUBLE_EQ(two.potentials[1], 1.25);
  EXPECT_EQ(two.error_bound, 0);
  const FarSums small = of_points({{0, 0, 0}, {4e-100, 0, 0}, {0, 1e-99, 0}}, {0, 1, 2});
  EXPECT_DOUBLE_EQ(small.potentials[0], 2.5e99 + 2e99);
  const FarSums large = of_points({{0, 0, 0}, {4e99, 0, 0}, {0, 1e99, 0}}, {0, 1, 2});
  EXPECT_DOUBLE_EQ(large.potentials[0], 0.25e-99 + 2e-99);
}

// One alone in a box sees its own images: six next to it, twelve over an edge, eight over a corner, and so
// on.
TEST(FarSums, OfOnePointInABoxAreOfItsImages) {
  FarSumParams params;
  params.kappa = 2;
  params.tolerance = 1e-10;
  const double side = 5,
               potential =
                   of_points({{1, 2, 3}}, {3}, params, Box::orthorhombic({side, side, side})).potentials[0];
  double expected = 0;
  for (int a = -6; a <= 6; ++a)
    for (int b = -6; b <= 6; ++b)
      for (int c = -6; c <= 6; ++c)
        if (const double r = side * std::sqrt(a * a + b * b + c * c); r > 0)
          expected += 3 * std::exp(-2 * r) / r;
  EXPECT_NEAR(potential, expected, 1e-10 * expected);
}

TEST(FarSums, LeaveOutPointsThatCoincide) {
  const std::size_t n = 20000;
  std::vector<Vec3> points = scenes::coincident(Box::none(), n);
  points.push_back(points.front() + Vec3{2, 0, 0});
  const FarSums sums = of_points(points, std::vector<double>(n + 1, 1.0));
  for (std::size_t k = 0; k < n; ++k) ASSERT_DOUBLE_EQ(sums.potentials[k], 0.5);
  EXPECT_DOUBLE_EQ(sums.potentials[n], n / 2.0);
  EXPECT_LE(sums.near_pairs, 100);
}

TEST(FarSums, BadInputIsNamed) {
  const PointTree open(liquid(2, Box::none()).view()),
      periodic(liquid(2, Box::orthorhombic({4, 4, 4})).view());
  const auto message = [&](const PointTree& tree, std::vector<double> charges, double tolerance,
                           double kappa) {
    FarSumParams params;
    params.tolerance = tolerance;
    params.kappa = kappa;
    return test::message_of<InvalidParameter>([&] { far_sums(tree, charges, params); });
  };
  using testing::HasSubstr;
  const std::vector<double> ones(8, 1.0);
  const double infinite = std::numeric_limits<double>::infinity(), nan = std::nan("");
  EXPECT_THAT(message(open, {1, 2}, 1e-4, 0), HasSubstr("2 charges for 8 ids"));
  std::vector<double> wrong = ones;
  wrong[3] = nan;
  EXPECT_THAT(message(open, wrong, 1e-4, 0), HasSubstr("charge of 3 is nan; its magnitude must be at most"));
  wrong[3] = -1e101;
  EXPECT_THAT(message(open, wrong, 1e-4, 0), HasSubstr("charge of 3 is -1e+101"));
  for (const auto& [tolerance, text] :
       {std::pair(0.0, "is 0;"), {-1.0, "is -1;"}, {1.0, "is 1;"}, {nan, "is nan;"}})
    EXPECT_THAT(message(open, ones, tolerance, 0), HasSubstr(std::string("tolerance of far sums ") + text));
  for (const auto& [kappa, text] : {std::pair(-1.0, "is -1;"), {nan, "is nan;"}, {infinite, "is inf;"}})
    EXPECT_THAT(message(open, ones, 1e-4, kappa), HasSubstr(std::string("kappa ") + text));
  EXPECT_THAT(message(periodic, ones, 1e-4, 0), HasSubstr("kappa is 0 in a periodic box (orthorhombic ppp)"));
  EXPECT_THAT(message(periodic, ones, 1e-4, 0.001),
              testing::AllOf(HasSubstr("kappa is 0.001; in a box with a shortest period of 4"),
                             HasSubstr("more than 1e+05 of them: take a larger kappa")));
}

}  // namespace

void check_far_sums(ProximityScene& scene) {
  Checked checked;
  check_scene(scene, checked);
}

}  // namespace dch
