// SPDX-License-Identifier: MIT
//
// The bound on the error of expansions where it is reached: a charge and a target, each on the side of its
// ball that faces the other.
#include "truncation.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "base/aligned_vector.hpp"
#include "expansions.hpp"

namespace dch::detail {
namespace {

/// Of a charge of 1 `size` from its center, at a target as far from its own, whose center is at distance 1.
double by_expansions(int order, double kappa, double size) {
  const Expansions expansions(order, kappa == 0);
  std::vector<double> whole(expansions.size()), moments(expansions.short_size()), local(expansions.size());
  expansions.add_charge(1, {1, 0, 0}, whole.data());
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

TEST(Truncation, BoundIsReachedByPointsThatFaceEachOther) {
  for (const auto& [kappa, slack] : {std::pair(0.0, 1.001), {0.5, 2.0}, {3.0, 2.0}}) {
    for (const double size : {0.05, 0.2, 0.4}) {
      ChargedNode source;
      source.radius = source.reach = size;
      source.weight = 1;
      for (int order = 1; order <= 12; ++order) {
        const double r = 1 - 2 * size, exact = std::exp(-kappa * r) / r;
        const double error = std::abs(by_expansions(order, kappa, size) - exact);
        if (error < 1e-10 * exact) break;  // rounding
        const Truncation truncation(order, kappa);
        const auto is_far = [&](double most) {
          return truncation.lowest_order(source, 1, size, most).order == order;
        };
        EXPECT_FALSE(is_far(0.999 * error)) << kappa << ' ' << size << ' ' << order;
        EXPECT_TRUE(is_far(slack * error)) << kappa << ' ' << size << ' ' << order;
      }
    }
  }
}

}  // namespace
}  // namespace dch::detail
