// SPDX-License-Identifier: MIT
//
// Generalized Born sums over cluster pairs, by each instruction set, on one thread and several, equal sums
// over all pairs in double; what they are derivatives of is differentiated by differences.
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/forces/generalized_born.hpp>

#include "error_message.hpp"
#include "instruction_sets.hpp"
#include "listed_hierarchy.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kBornCutoff = 1.2;
constexpr std::size_t kSolutes = 500;

/// Particles anywhere, that may overlap, and some at the same place.
struct Solute {
  std::size_t count;
  Box box;
  std::vector<Vec3> points;
  std::vector<BornParticle> particles;
  std::vector<double> charges, born, slopes;
  BornNecks necks;
  bool counts_inside, has_necks;
  BornEnergy energy;
  ClusterPairs pairs;

  Solute(std::uint64_t seed, bool inside, bool with_necks, double kappa,
         std::size_t particle_count = kSolutes)
      : count(particle_count), box(box_of(particle_count)), counts_inside(inside), has_necks(with_necks) {
    scenes::Random random(seed);
    energy = {1.5, 0.8, 0.03, kappa, 1 / kBornCutoff};
    necks.kinds = with_necks ? 5 : 0;
    necks.scale = 0.4;
    necks.reach = 0.7;
    for (int k = 0; k < necks.kinds * necks.kinds; ++k) {
      necks.at.push_back(random.uniform(0.2, 0.4));
      necks.height.push_back(random.uniform(0.1, 0.6));
    }
    for (std::size_t i = 0; i < count; ++i) {
      points.push_back(scenes::from_fractional(box, {random.uniform(), random.uniform(), random.uniform()}));
      particles.push_back({random.uniform(0.08, 0.2), random.uniform(-0.05, 0.22)});
      charges.push_back(random.uniform(-1, 1));
      born.push_back(random.uniform(0.1, 0.5));
      slopes.push_back(random.uniform(-2, 2));
      if (with_necks) necks.kind.push_back(static_cast<std::int32_t>(random.below(5)));
    }
    points[7] = points[8];
    ListParams request;
    request.cutoffs = TypeCutoffs(kBornCutoff);
    request.skin = 0.1;
    HierarchyParams params;
    params.radius = request.list_radius();
    ListedHierarchy hierarchy(params);
    hierarchy.build(points, box);
    hierarchy.cluster_pairs(request, pairs);
  }
  static Box box_of(std::size_t count) {
    const double scale = std::cbrt(static_cast<double>(count) / kSolutes);
    return Box::orthorhombic(scale * Vec3{2.9, 3.1, 3.3});
  }
  BornSums sums() const {
    BornSums made(kBornCutoff, particles, counts_inside);
    if (has_necks) made.set_necks(necks);
    return made;
  }
};

/// What the integral of i gets from j, by the formulas.
long double integral_of(const Solute& of, std::size_t i, std::size_t j, long double r) {
  const long double a = of.particles[i].radius, s = of.particles[j].scaled;
  long double sum = 0;
  if (a < r + s) {
    const long double u = r + s, l = std::max(a, std::abs(r - s));
    sum = (1 / l - 1 / u + (r - s * s / r) * (1 / (u * u) - 1 / (l * l)) / 4 + std::log(l / u) / r / 2) / 2;
    if (of.counts_inside && a < s - r) sum += 1 / a - 1 / l;
  }
  if (of.has_necks && r < of.particles[i].radius + of.particles[j].radius + of.necks.reach) {
    const auto k = static_cast<std::size_t>(of.necks.kind[i] * of.necks.kinds + of.necks.kind[j]);
    const long double x = r - of.necks.at[k];
    sum += of.necks.scale * of.necks.height[k] / (1 + 100 * x * x + 3e5L * std::pow(x, 6));
  }
  return sum;
}

long double energy_of(const Solute& of, std::size_t i, std::size_t j, long double r, long double b) {
  const BornEnergy& e = of.energy;
  const long double product = b * of.born[j],
                    f = std::sqrt(r * r + product * std::exp(-r * r / (4 * product)));
  return -e.constant * of.charges[i] * of.charges[j] *
         (e.over_solute - std::exp(-e.kappa * f) * e.over_solvent) * (1 / f - e.shift);
}

double slope_of(const std::function<long double(long double)>& value, long double at) {
  constexpr long double kStep = 1e-7L;
  return static_cast<double>((value(at + kStep) - value(at - kStep)) / (2 * kStep));
}

struct BornResult {
  explicit BornResult(std::size_t count)
      : integrals(count), slopes(count), of_energies(count), of_chain(count) {}
  std::vector<double> integrals, slopes;
  double energy = 0;
  std::vector<Vec3> of_energies, of_chain;
};

BornResult all_pairs_of(const Solute& of) {
  BornResult result(of.count);
  for (std::size_t i = 0; i < of.count; ++i)
    for (std::size_t j = 0; j < of.count; ++j) {
      const Vec3 d = of.box.nearest_image(of.points[j] - of.points[i]);
      const double r = std::sqrt(norm2(d));
      if (i == j || r >= kBornCutoff) continue;
      const long double apart = std::max<long double>(r, 1e-6L);
      result.integrals[i] += static_cast<double>(integral_of(of, i, j, apart));
      result.energy += static_cast<double>(energy_of(of, i, j, r, of.born[i]) / 2);
      result.slopes[i] += slope_of([&](long double b) { return energy_of(of, i, j, r, b); }, of.born[i]);
      if (r == 0) continue;
      const double energy = slope_of([&](long double x) { return energy_of(of, i, j, x, of.born[i]); }, r);
      const double chain =
          of.slopes[i] * slope_of([&](long double x) { return integral_of(of, i, j, x); }, r) +
          of.slopes[j] * slope_of([&](long double x) { return integral_of(of, j, i, x); }, r);
      result.of_energies[i] = result.of_energies[i] + (energy / r) * d;
      result.of_chain[i] = result.of_chain[i] + (chain / r) * d;
    }
  return result;
}

BornResult sums_of(const Solute& of, Executor* executor) {
  BornResult result(of.count);
  BornSums sums = of.sums();
  EXPECT_TRUE(sums.fits_single());
  sums.set_executor(executor);
  sums.add_integrals(of.pairs, result.integrals);
  result.energy =
      sums.add_energies(of.pairs, of.energy, of.charges, of.born, result.of_energies, result.slopes, true);
  sums.add_chain(of.pairs, of.slopes, result.of_chain);
  BornResult again(of.count);
  EXPECT_EQ(
      sums.add_energies(of.pairs, of.energy, of.charges, of.born, again.of_energies, again.slopes, false), 0);
  EXPECT_EQ(again.slopes, result.slopes);
  return result;
}

/// The root mean square of differences over that of what is expected.
double error_of(const std::vector<Vec3>& expected, const std::vector<Vec3>& found) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    error += norm2(found[i] - expected[i]);
    size += norm2(expected[i]);
  }
  return std::sqrt(error / size);
}
double error_of(const std::vector<double>& expected, const std::vector<double>& found) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    error += std::pow(found[i] - expected[i], 2);
    size += std::pow(expected[i], 2);
  }
  return std::sqrt(error / size);
}

TEST(GeneralizedBorn, SumsEqualThoseOfAllPairs) {
  const RestoreInstructionSet restore;
  for (const bool inside : {false, true})
    for (const bool necks : {false, true}) {
      const Solute solute(1 + (inside ? 2 : 0) + (necks ? 1 : 0), inside, necks, necks ? 0.7 : 0);
      const BornResult expected = all_pairs_of(solute);
      for (const InstructionSet set : supported_sets()) {
        set_instruction_set(set);
        SCOPED_TRACE(testing::Message() << name(set) << ", inside " << inside << ", necks " << necks);
        const BornResult found = sums_of(solute, nullptr);
        EXPECT_LT(error_of(expected.integrals, found.integrals), 2e-6);
        EXPECT_LT(error_of(expected.slopes, found.slopes), 2e-6);
        EXPECT_LT(error_of(expected.of_energies, found.of_energies), 2e-6);
        EXPECT_LT(error_of(expected.of_chain, found.of_chain), 5e-6);
        EXPECT_NEAR(found.energy, expected.energy, 1e-5 * std::abs(expected.energy));
      }
    }
}

TEST(GeneralizedBorn, SumsAreTheSameOnAnyNumberOfThreads) {
  const Solute solute(9, true, true, 0, 20000);
  ASSERT_GT(solute.pairs.tasks.size(), 3U);
  const BornResult expected = sums_of(solute, nullptr);
  for (std::size_t i = 0; i < solute.count; i += 400) {  // nothing is lost from one task to another
    double integral = 0;
    for (std::size_t j = 0; j < solute.count; ++j)
      if (const double r = std::sqrt(norm2(solute.box.nearest_image(solute.points[j] - solute.points[i])));
          i != j && r < kBornCutoff)
        integral += static_cast<double>(integral_of(solute, i, j, std::max(r, 1e-6)));
    EXPECT_NEAR(expected.integrals[i], integral, 1e-5 * (1 + std::abs(integral))) << i;
  }
  for (const auto* const forces : {&expected.of_energies, &expected.of_chain}) {
    Vec3 sum{0, 0, 0};
    double size = 0;
    for (const Vec3 f : *forces) {
      sum = sum + f;
      size += std::sqrt(norm2(f));
    }
    EXPECT_LT(std::sqrt(norm2(sum)), 1e-7 * size);
  }
  for (const int threads : {2, 3}) {
    const auto pool = make_thread_pool(threads);
    const BornResult found = sums_of(solute, pool.get());
    EXPECT_EQ(found.integrals, expected.integrals);
    EXPECT_EQ(found.slopes, expected.slopes);
    EXPECT_EQ(found.energy, expected.energy);
    EXPECT_EQ(error_of(expected.of_energies, found.of_energies), 0);
    EXPECT_EQ(error_of(expected.of_chain, found.of_chain), 0);
  }
}

TEST(GeneralizedBorn, WhatDoesNotFitIsRefused) {
  const auto refusal = [](const std::function<void()>& call) {
    return test::message_of<InvalidParameter>(call);
  };
  const std::vector<BornParticle> one{{0.1, 0.1}};
  EXPECT_NE(refusal([&] { BornSums(0, one, false); }), "");
  EXPECT_NE(refusal([&] { BornSums(std::numeric_limits<double>::infinity(), one, false); }), "");
  EXPECT_NE(refusal([&] { BornSums(1, std::vector<BornParticle>{{0, 0.1}}, false); }), "");
  EXPECT_NE(refusal([&] { BornSums(1, std::vector<BornParticle>{{0.1, std::nan("")}}, false); }), "");
  BornSums sums(1, one, false);
  BornNecks necks{2, {1, 1, 1, 1}, {1, 1, 1}, 1, 1, {0}};
  EXPECT_NE(refusal([&] { sums.set_necks(necks); }), "");
  necks.height.push_back(1);
  EXPECT_NO_THROW(sums.set_necks(necks));
  for (const std::int32_t kind : {-1, 2}) {
    necks.kind[0] = kind;
    EXPECT_NE(refusal([&] { sums.set_necks(necks); }), "");
  }
  const Solute solute(5, true, false, 0);
  std::vector<double> numbers(kSolutes);
  EXPECT_NE(refusal([&] { sums.add_integrals(solute.pairs, numbers); }), "");
  BornSums wide(2 * kBornCutoff, solute.particles, false);
  EXPECT_NE(refusal([&] { wide.add_integrals(solute.pairs, numbers); }), "");
  EXPECT_FALSE(BornSums(1, std::vector<BornParticle>{{1e-4, 0.1}}, false).fits_single());
}

}  // namespace
}  // namespace dch
