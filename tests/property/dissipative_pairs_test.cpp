// SPDX-License-Identifier: MIT
//
// Forces of dissipative particle dynamics against the formula in plain loops, on every instruction set.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/forces/dissipative_pairs.hpp>
#include <dch/forces/langevin.hpp>

#include "instruction_sets.hpp"
#include "random.hpp"

namespace dch {
namespace {

DissipativeParams two_types() {
  DissipativeParams params;
  params.types = 2;
  params.pairs = {{25, 4.5, 1.0}, {-3, 2.0, 1.3}, {-3, 2.0, 1.3}, {0, 7.5, 0}};
  params.seed = 0xfedcba98;
  params.weight = {1, 0, 0.25, 0.7};
  return params;
}

/// A whole batch of pairs that are nearer and farther than their cutoffs, and of two on one place.
DissipativeBatch any_pairs(scenes::Random& random, int count) {
  DissipativeBatch batch;
  batch.count = count;
  for (int k = 0; k < count; ++k) {
    for (double* numbers : {batch.x, batch.y, batch.z}) numbers[k] = random.uniform(-0.9, 0.9);
    for (double* numbers : {batch.vx, batch.vy, batch.vz}) numbers[k] = random.uniform(-3, 3);
    batch.first_id[k] = 1 + static_cast<std::int32_t>(random.below(1000));
    batch.second_id[k] = 1 + static_cast<std::int32_t>(random.below(2147483000));
    batch.types[k] = static_cast<std::int32_t>(random.below(4));
    batch.kind[k] = static_cast<std::int32_t>(random.below(4));
  }
  if (count > 3) {
    batch.x[3] = batch.y[3] = batch.z[3] = 0;
    batch.x[1] = 3e-11, batch.y[1] = batch.z[1] = 0;
  }
  return batch;
}

double noise_of(const DissipativeParams& params, std::int64_t step, std::int32_t a, std::int32_t b) {
  const auto words =
      philox4x32({static_cast<std::uint32_t>(std::min(a, b)), static_cast<std::uint32_t>(std::max(a, b)),
                  static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(step >> 32)},
                 {params.seed, 1});
  return std::sqrt(12.0) * ((words[0] + 0.5) / 4294967296.0 - 0.5);
}

struct Expected {
  double force_over_r, energy, scale;
};

Expected expected(const DissipativeParams& params, const DissipativeStep& step, const DissipativeBatch& batch,
                  int k) {
  const DissipativePair& pair = params.pairs[static_cast<std::size_t>(batch.types[k])];
  const double weight = params.weight[static_cast<std::size_t>(batch.kind[k])];
  const double r = std::sqrt(batch.x[k] * batch.x[k] + batch.y[k] * batch.y[k] + batch.z[k] * batch.z[k]);
  if (r < 1e-10 || r >= pair.cutoff) return {0, 0, 1};
  const double w = 1 - r / pair.cutoff;
  const double approach =
      (batch.x[k] * batch.vx[k] + batch.y[k] * batch.vy[k] + batch.z[k] * batch.vz[k]) / r;
  const double repulsion = weight * pair.repulsion * w, drag = weight * pair.friction * w * w * approach;
  const double random_force = std::sqrt(weight * 2 * pair.friction * step.thermal_energy / step.duration) *
                              w * noise_of(params, step.number, batch.first_id[k], batch.second_id[k]);
  return {(repulsion - drag + random_force) / r, 0.5 * weight * pair.repulsion * pair.cutoff * w * w,
          (std::abs(repulsion) + std::abs(drag) + std::abs(random_force)) / r + 1e-3};
}

TEST(DissipativePairsTest, AreThoseOfTheFormula) {
  const RestoreInstructionSet restore;
  const DissipativeParams params = two_types();
  const DissipativePairs forces(params);
  const DissipativeStep step{0x123456789, 1.3, 0.04};
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    scenes::Random random(7);
    int acting = 0;
    for (const int count : {64, 63, 5, 1, 0}) {
      DissipativeBatch batch = any_pairs(random, count);
      for (int k = count; k < DissipativeBatch::kSize; ++k) batch.types[k] = batch.kind[k] = 2000000000;
      forces.compute(step, batch);
      for (int k = 0; k < count; ++k) {
        const Expected found = expected(params, step, batch, k);
        EXPECT_NEAR(batch.force_over_r[k], found.force_over_r, 1e-13 * found.scale) << set << ' ' << k;
        EXPECT_NEAR(batch.energy[k], found.energy, 1e-13 * (1 + std::abs(found.energy))) << set << ' ' << k;
        acting += found.force_over_r != 0 ? 1 : 0;
      }
    }
    EXPECT_GT(acting, 40);
  }
}

TEST(DissipativePairsTest, ActAlikeOnBothParticles) {
  const DissipativePairs forces(two_types());
  scenes::Random random(8);
  DissipativeBatch batch = any_pairs(random, 64), turned = batch;
  for (double* numbers : {turned.x, turned.y, turned.z, turned.vx, turned.vy, turned.vz})
    for (int k = 0; k < 64; ++k) numbers[k] = -numbers[k];
  std::swap(turned.first_id, turned.second_id);
  forces.compute({5, 1, 0.01}, batch);
  forces.compute({5, 1, 0.01}, turned);
  for (int k = 0; k < 64; ++k) EXPECT_EQ(batch.force_over_r[k], turned.force_over_r[k]);
}

/// Random forces alone, over their root mean square, of pairs (1, k), (2, k) and so on.
std::vector<double> kicks(std::int64_t steps) {
  DissipativeParams params;
  params.pairs = {{0, 2.0, 1.0}};
  params.seed = 904297;
  const DissipativePairs forces(params);
  std::vector<double> found;
  for (std::int64_t step = 0; step < steps; ++step)
    for (std::int32_t first = 1; first <= 40; ++first) {
      DissipativeBatch batch;
      batch.count = DissipativeBatch::kSize;
      for (int k = 0; k < batch.count; ++k) {
        batch.x[k] = 0.5;
        batch.first_id[k] = first;
        batch.second_id[k] = 100 + k;
      }
      forces.compute({step, 1.5, 0.02}, batch);
      // sqrt(2 friction k T / dt) w / r
      for (const double force : batch.force_over_r) found.push_back(force / std::sqrt(2 * 2.0 * 1.5 / 0.02));
    }
  return found;
}

// With a fixed seed; a perfect generator passes each bound with a probability of at least 1 - 1e-6.
TEST(DissipativePairsTest, RandomForcesHaveTheMomentsAndAreIndependent) {
  const std::vector<double> n = kicks(40);
  const auto count = static_cast<double>(n.size());
  double sum[5] = {};
  for (const double value : n)
    for (int k = 1; k <= 4; ++k) sum[k] += std::pow(value, k);
  // Of a uniform number of variance 1: moments 0, 1, 0, 9/5, and the variances of its powers.
  const double moment[5] = {1, 0, 1, 0, 1.8}, variance[5] = {0, 1, 0.8, 27.0 / 7, 9 - 3.24};
  for (int k = 1; k <= 4; ++k)
    EXPECT_NEAR(sum[k] / count, moment[k], 5 * std::sqrt(variance[k] / count)) << k;
  // The next pair of the same first atom, the next first atom, the next step.
  for (const std::size_t apart : {1u, 64u, 64u * 40u}) {
    double product = 0;
    for (std::size_t k = 0; k + apart < n.size(); ++k) product += n[k] * n[k + apart];
    EXPECT_LT(std::abs(product), 5 * std::sqrt(count)) << apart;
  }
}

TEST(DissipativePairsTest, RefusesWhatHasNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](auto&& change, const std::string& words) {
    DissipativeParams params = two_types();
    change(params);
    try {
      const DissipativePairs forces(params);
      ADD_FAILURE() << words;
    } catch (const InvalidParameter& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  refused([&](auto& p) { p.pairs[0].repulsion = nan; }, "the repulsion is nan; it must be finite");
  refused([&](auto& p) { p.pairs[3].friction = -1; }, "types 1 and 1: the friction is -1");
  refused([&](auto& p) { p.pairs[3].cutoff = nan; }, "the cutoff is nan");
  refused([&](auto& p) { p.pairs[1].repulsion = 5; }, "types 0 and 1 differ from those of types 1 and 0");
  refused([&](auto& p) { p.pairs.pop_back(); }, "3 dissipative pairs given for 2 types");
  refused([&](auto& p) { p.types = 0; }, "4 dissipative pairs given for 0 types");
  refused([&](auto& p) { p.weight[2] = 1.5; }, "of kind 2 is 1.5; it must be from 0 to 1");
  refused([&](auto& p) { p.weight[0] = 0.5; }, "of kind 0 is 0.5; it must be 1");
  const DissipativePairs forces(two_types());
  DissipativeBatch batch;
  for (const DissipativeStep& step :
       {DissipativeStep{0, -1, 1}, DissipativeStep{0, 1, 0}, DissipativeStep{0, nan, 1}})
    EXPECT_THROW(forces.compute(step, batch), InvalidParameter);
  for (const int count : {-1, DissipativeBatch::kSize + 1}) {
    batch.count = count;
    EXPECT_THROW(forces.compute({0, 1, 1}, batch), InvalidParameter);
  }
}

}  // namespace
}  // namespace dch
