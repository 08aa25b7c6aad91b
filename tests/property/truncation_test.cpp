// SPDX-License-Identifier: MIT
//
// The bound on the error of expansions where it is reached: charges and a target on the line through the
// centers. And the sizes of moments against sums over all pairs of charges.
#include "truncation.hpp"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "base/aligned_vector.hpp"
#include "charged_tree.hpp"
#include "expansions.hpp"
#include "instruction_sets.hpp"
#include "moment_sizes.hpp"
#include "scenes.hpp"

namespace dch::detail {
namespace {

/// Charges on the axis of x, from their center at 0 on; the center of targets is at distance 1.
struct OnAxis {
  std::vector<double> charges, at;
  double size;  ///< of both balls

  ChargedNode node(int degree) const {
    ChargedNode node;
    node.radius = node.reach = size;
    MeasureMoments moments(degree);
    for (const double charge : charges) node.weight += std::abs(charge);
    for (std::size_t k = 0; k < charges.size(); ++k)
      moments.add(charges[k] / node.weight, {at[k] / size, 0, 0});
    node.moments = moments.sizes(1);
    return node;
  }

  /// At the side of the target's ball that faces the charges.
  double by_expansions(int order, double kappa) const {
    const Expansions expansions(order, kappa == 0);
    std::vector<double> whole(expansions.size()), moments(expansions.short_size()), local(expansions.size());
    for (std::size_t k = 0; k < charges.size(); ++k)
      expansions.add_charge(charges[k], {at[k] / size, 0, 0}, whole.data());
    expansions.shorten(whole.data(), moments.data());
    FarGroup group{};
    const std::vector<double> none(expansions.short_size());
    for (auto& of_lane : group.moments) of_lane = none.data();
    group.moments[0] = moments.data();
    group.direction[0][0] = group.inverse[0] = 1;
    group.screening[0] = kappa;
    group.decay[0] = std::exp(-kappa);
    group.source_size[0] = group.target_size[0] = size;
    AlignedVector<double> work(expansions.work_size()), lanes(expansions.short_size() * kSumLanes);
    sum_kernels(instruction_set()).translate(expansions.tables(), group, work.data(), lanes.data());
    std::vector<double> sums;
    for (std::size_t k = 0; k < lanes.size(); k += kSumLanes) sums.push_back(lanes[k]);
    expansions.add_whole(sums.data(), local.data());
    return expansions.potential(local.data(), {-1, 0, 0});
  }

  double exact(double kappa) const {
    double sum = 0;
    for (std::size_t k = 0; k < charges.size(); ++k) {
      const double r = 1 - size - at[k];
      sum += charges[k] * std::exp(-kappa * r) / r;
    }
    return sum;
  }

  /// An error that is smaller than it is must not be taken for far, one that is larger must.
  void expect_that_bound_is_reached(double kappa, double slack) const {
    for (int order = 1; order <= 12; ++order) {
      const double error = std::abs(by_expansions(order, kappa) - exact(kappa));
      if (error < 1e-9 * std::abs(exact(kappa))) break;  // rounding, also of moments
      const Truncation truncation(order, kappa);
      const ChargedNode source = node(truncation.degree());
      const auto is_far = [&](double most) {
        const Expanded by = truncation.lowest_order(source, 1, size, most);
        return by.is_far && by.order <= order;
      };
      EXPECT_FALSE(is_far(0.999 * error)) << kappa << ' ' << size << ' ' << order;
      EXPECT_TRUE(is_far(slack * error)) << kappa << ' ' << size << ' ' << order;
    }
  }
};

TEST(Truncation, BoundIsReachedByPointsThatFaceEachOther) {
  for (const auto& [kappa, slack] : {std::pair(0.0, 1.001), {0.5, 2.0}, {3.0, 2.0}})
    for (const double size : {0.05, 0.2, 0.4})
      OnAxis{{1}, {size}, size}.expect_that_bound_is_reached(kappa, slack);
}

// Without what the moments say the bound of a dipole would be several times what it is.
TEST(Truncation, BoundOfUnlikeChargesIsNearlyReached) {
  for (const double size : {0.05, 0.1, 0.2}) {
    OnAxis{{1, -1}, {size, -size}, size}.expect_that_bound_is_reached(0, 1.1);
    OnAxis{{3, -2}, {size, 0.7 * size}, size}.expect_that_bound_is_reached(0, 1.5);
  }
}

double legendre(int degree, double x) {
  double before = 0, at = 1;
  for (int l = 0; l < degree; ++l) {
    const double next = ((2 * l + 1) * x * at - l * before) / (l + 1);
    before = at;
    at = next;
  }
  return at;
}

TEST(Truncation, SizesOfMomentsAreThoseOfAllPairs) {
  scenes::Random random(7);
  for (const std::size_t count : {std::size_t{1}, std::size_t{3}, std::size_t{8}, std::size_t{21}}) {
    MeasureMoments moments(kMaxDegree);
    std::vector<double> charges;
    std::vector<Vec3> at;
    for (std::size_t k = 0; k < count; ++k) {
      charges.push_back(random.uniform(-1, 1));
      at.push_back({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
      moments.add(charges[k], at[k]);
    }
    const MomentSizes sizes = moments.sizes(static_cast<double>(count));
    double factorial = 1;
    for (int l = 0; l <= kMaxDegree; ++l) {
      if (l > 0) factorial *= l;
      double squares = 0;
      for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = 0; b < count; ++b) {
          const double lengths = std::sqrt(norm2(at[a]) * norm2(at[b]));
          squares +=
              charges[a] * charges[b] * std::pow(lengths, l) * legendre(l, dot(at[a], at[b]) / lengths);
        }
      const double expected = std::sqrt(squares) / factorial;
      EXPECT_NEAR(double{sizes[static_cast<std::size_t>(l)]}, expected, 1e-5 * expected) << count << ' ' << l;
      EXPECT_GE(double{sizes[static_cast<std::size_t>(l)]}, expected * (1 - 1e-12)) << count << ' ' << l;
    }
  }
}

TEST(Truncation, SizesOfMomentsAreTheSameWithAnyInstructionSet) {
  const RestoreInstructionSet restore;
  const auto sizes = [] {
    scenes::Random random(8);
    MeasureMoments moments(kMaxDegree);
    for (int k = 0; k < 30; ++k)
      moments.add(random.uniform(-1, 1),
                  {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    return moments.sizes(30);
  };
  const MomentSizes expected = sizes();
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    EXPECT_EQ(sizes(), expected) << name(set);
  }
}

}  // namespace
}  // namespace dch::detail
