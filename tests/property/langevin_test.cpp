// SPDX-License-Identifier: MIT
//
// Random numbers of a bath: known answers, the same from every instruction set, and what they are distributed
// like.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/forces/langevin.hpp>

#include "instruction_sets.hpp"
#include "random.hpp"

namespace dch {
namespace {

using Words = std::array<std::uint32_t, 4>;

std::vector<std::int32_t> ids_up_to(std::int32_t count) {
  std::vector<std::int32_t> ids;
  for (std::int32_t id = 1; id <= count; ++id) ids.push_back(id);
  return ids;
}

std::vector<Vec3> noise_of(std::uint32_t seed, std::int64_t step, const std::vector<std::int32_t>& ids) {
  std::vector<Vec3> noise(ids.size());
  uniform_noise(seed, step, ids, noise);
  return noise;
}

double axis_of(const Vec3& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

// The lines "philox4x32 10" of tests/kat_vectors of Random123, the program of the authors.
TEST(PhiloxTest, KnownAnswers) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t kOnes = 0xffffffff;
  EXPECT_EQ(philox4x32({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(NoiseTest, IsMadeOfPhiloxWords) {
  const RestoreInstructionSet restore;
  const std::int64_t long_run = 0x123456789;
  for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 300u}) {
    std::vector<std::int32_t> ids = ids_up_to(static_cast<std::int32_t>(count));
    if (count > 1) ids[1] = 2147483647;
    std::vector<Vec3> expected;
    for (const std::int32_t id : ids) {
      const Words words = philox4x32({static_cast<std::uint32_t>(id), 0x23456789, 1, 0}, {0xfedcba98, 0});
      const auto uniform = [](std::uint32_t word) { return (word + 0.5) / 4294967296.0 - 0.5; };
      expected.push_back({uniform(words[0]), uniform(words[1]), uniform(words[2])});
    }
    for (const InstructionSet set : supported_sets()) {
      set_instruction_set(set);
      EXPECT_EQ(noise_of(0xfedcba98, long_run, ids), expected) << set << ' ' << count;
    }
  }
}

TEST(NoiseTest, DoesNotDependOnTheOrderOfParticles) {
  std::vector<std::int32_t> ids = ids_up_to(200);
  const std::vector<Vec3> in_order = noise_of(7, 1000, ids);
  scenes::Random random(3);
  for (std::size_t k = ids.size() - 1; k > 0; --k) std::swap(ids[k], ids[random.below(k + 1)]);
  const std::vector<Vec3> shuffled = noise_of(7, 1000, ids);
  for (std::size_t k = 0; k < ids.size(); ++k)
    EXPECT_EQ(shuffled[k], in_order[static_cast<std::size_t>(ids[k] - 1)]);
}

// Statistics: with fixed seeds, each bound is passed by a perfect generator with a probability of at least 1
// - 1e-6: 5 standard deviations of a sum of so many numbers.
constexpr double kDeviations = 5;
constexpr int kParticles = 20000, kSteps = 20;
constexpr double kNumbers = 3.0 * kParticles * kSteps;

std::vector<std::vector<Vec3>> noise_of_steps() {
  std::vector<std::vector<Vec3>> of_steps;
  for (int step = 0; step < kSteps; ++step)
    of_steps.push_back(noise_of(904297, 100 + step, ids_up_to(kParticles)));
  return of_steps;
}

TEST(NoiseTest, HasTheMomentsOfAUniformDistribution) {
  double sum[5] = {};
  for (const auto& noise : noise_of_steps())
    for (const Vec3& v : noise)
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (int k = 1; k <= 4; ++k) sum[k] += std::pow(axis_of(v, axis), k);
  // Moments 0, 1/12, 0, 1/80 of a number between -1/2 and 1/2, and the variances of its powers.
  const double moment[5] = {1, 0, 1.0 / 12, 0, 1.0 / 80};
  const double variance[5] = {0, 1.0 / 12, 1.0 / 180, 1.0 / 448, 1.0 / 3600};
  for (int k = 1; k <= 4; ++k)
    EXPECT_NEAR(sum[k] / kNumbers, moment[k], kDeviations * std::sqrt(variance[k] / kNumbers)) << k;
}

/// The correlation of pairs of numbers, in standard deviations of that of independent ones.
template <class First, class Second>
double correlation(First first, Second second, std::size_t count) {
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += first(k) * second(k);
  return 12 * sum / std::sqrt(static_cast<double>(count));
}

TEST(NoiseTest, AxesParticlesStepsAndSeedsAreIndependent) {
  const auto of_steps = noise_of_steps();
  const std::size_t all = static_cast<std::size_t>(kParticles) * kSteps;
  const auto at = [&](std::size_t k, std::size_t axis) {
    return axis_of(of_steps[k / kParticles][k % kParticles], axis);
  };
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      if (a < b) {
        EXPECT_LT(
            std::abs(correlation([&](auto k) { return at(k, a); }, [&](auto k) { return at(k, b); }, all)),
            kDeviations);
      }
      for (const std::size_t apart :
           {std::size_t{1}, std::size_t{2}, std::size_t{100}, std::size_t{kParticles}})
        EXPECT_LT(std::abs(correlation([&](auto k) { return at(k, a); },
                                       [&](auto k) { return at(k + apart, b); }, all - apart)),
                  kDeviations)
            << a << ' ' << b << ' ' << apart;
    }
  const std::vector<Vec3> other_seed = noise_of(904298, 100, ids_up_to(kParticles));
  EXPECT_LT(std::abs(correlation([&](auto k) { return at(k, 0); }, [&](auto k) { return other_seed[k].x; },
                                 kParticles)),
            kDeviations);
}

/// Chi-square of counts that should be equal, in its standard deviations from its mean.
double deviation_of_chi_square(const std::vector<double>& counts) {
  double total = 0, sum = 0;
  for (const double count : counts) total += count;
  const auto bins = static_cast<double>(counts.size());
  for (const double count : counts) sum += (count - total / bins) * (count - total / bins);
  return (sum * bins / total - (bins - 1)) / std::sqrt(2 * (bins - 1));
}

TEST(NoiseTest, FillsCubesEvenlyByChiSquare) {
  // The three numbers of a particle, and the first of a particle with those of the next two.
  constexpr std::size_t kBins = 16;
  std::vector<double> of_axes(kBins * kBins * kBins), of_particles(of_axes);
  const auto bin = [](double u) { return static_cast<std::size_t>((u + 0.5) * kBins); };
  for (const auto& noise : noise_of_steps())
    for (std::size_t k = 0; k + 2 < noise.size(); ++k) {
      ++of_axes[(bin(noise[k].x) * kBins + bin(noise[k].y)) * kBins + bin(noise[k].z)];
      ++of_particles[(bin(noise[k].x) * kBins + bin(noise[k + 1].x)) * kBins + bin(noise[k + 2].x)];
    }
  EXPECT_LT(std::abs(deviation_of_chi_square(of_axes)), kDeviations);
  EXPECT_LT(std::abs(deviation_of_chi_square(of_particles)), kDeviations);
}

TEST(NoiseTest, IsUniformByKolmogorovAndSmirnov) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> sorted;
    for (const auto& noise : noise_of_steps())
      for (const Vec3& v : noise) sorted.push_back(axis_of(v, axis) + 0.5);
    std::sort(sorted.begin(), sorted.end());
    const auto count = static_cast<double>(sorted.size());
    double worst = 0;
    for (std::size_t k = 0; k < sorted.size(); ++k)
      worst = std::max({worst, sorted[k] - static_cast<double>(k) / count,
                        static_cast<double>(k + 1) / count - sorted[k]});
    EXPECT_LT(worst * std::sqrt(count), 2.69);  // exceeded with a probability of 2 exp(-2 2.69^2) = 1e-6
  }
}

std::vector<double> ranmar_numbers(RanmarNoise& generator, std::size_t vectors) {
  std::vector<Vec3> noise(vectors);
  generator.draw(noise);
  std::vector<double> numbers;
  for (const Vec3& v : noise) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  return numbers;
}

// James (1990): the numbers behind the first 20,000 from seeds 1802 and 9373, times 2^24. LAMMPS's seed is
// one above 30082 times the first and the second, and its first number has been drawn.
TEST(RanmarTest, KnownAnswers) {
  const RestoreInstructionSet restore;
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    RanmarNoise generator(1802 * 30082 + 9373 + 1);
    std::vector<double> found = ranmar_numbers(generator, 6669);
    found.erase(found.begin(), found.begin() + 19999);
    found.resize(6);
    for (double& number : found) number = (number + 0.5) * 16777216;
    EXPECT_EQ(found, (std::vector<double>{6533892, 14220222, 7275067, 6172232, 8354498, 10633180})) << set;
  }
}

/// One number after another, in floating point, as Marsaglia, Zaman and Tsang write it down.
class PlainRanmar {
 public:
  explicit PlainRanmar(int seed) {
    const int first = (seed - 1) / 30082, second = (seed - 1) % 30082;
    int i = (first / 177) % 177 + 2, j = first % 177 + 2, k = (second / 169) % 178 + 1, l = second % 169;
    for (double& sum : sums_) {
      double bit = 0.5;
      for (int n = 0; n < 24; ++n, bit /= 2) {
        const int m = (((i * j) % 179) * k) % 179;
        i = j, j = k, k = m;
        l = (53 * l + 1) % 169;
        if ((l * m) % 64 >= 32) sum += bit;
      }
    }
    next();
  }

  double next() {
    double sum = sums_[at_] - sums_[(at_ + 97 - 64) % 97];
    if (sum < 0) sum += 1;
    sums_[at_] = sum;
    at_ = (at_ + 96) % 97;
    shift_ -= 7654321.0 / 16777216;
    if (shift_ < 0) shift_ += 16777213.0 / 16777216;
    return sum < shift_ ? sum - shift_ + 1 : sum - shift_;
  }

 private:
  std::array<double, 97> sums_{};
  std::size_t at_ = 96;
  double shift_ = 362436.0 / 16777216;
};

TEST(RanmarTest, IsThePlainGeneratorInPiecesOfAnySize) {
  const RestoreInstructionSet restore;
  for (const int seed : {1, 904297, 900000000})
    for (const InstructionSet set : supported_sets()) {
      set_instruction_set(set);
      RanmarNoise generator(seed);
      PlainRanmar plain(seed);
      for (const std::size_t vectors : {1u, 0u, 10u, 11u, 32u, 33u, 127u, 128u, 129u, 300u, 2u, 1000u}) {
        std::vector<double> expected;
        for (std::size_t k = 0; k < 3 * vectors; ++k) expected.push_back(plain.next() - 0.5);
        EXPECT_EQ(ranmar_numbers(generator, vectors), expected) << seed << ' ' << set << ' ' << vectors;
      }
    }
}

TEST(LangevinTest, HasTheBitsOfAPlainLoop) {
  const RestoreInstructionSet restore;
  for (const std::size_t count : {0u, 1u, 7u, 8u, 129u}) {
    scenes::Random random(29);
    std::vector<double> drag, strength;
    std::vector<Vec3> velocities, noise, before, expected;
    for (std::size_t i = 0; i < count; ++i) {
      drag.push_back(-random.uniform());
      strength.push_back(30 * random.uniform());
      velocities.push_back(random.in_cube(3));
      noise.push_back(random.in_cube(0.5));
      before.push_back(random.in_cube(100));
      // Rounded before they are added, whatever the compiler fuses.
      const auto bath = [&](double v, double u) {
        const volatile double of_drag = drag[i] * v, of_noise = strength[i] * u;
        return of_drag + of_noise;
      };
      expected.push_back(before[i] + Vec3{bath(velocities[i].x, noise[i].x),
                                          bath(velocities[i].y, noise[i].y),
                                          bath(velocities[i].z, noise[i].z)});
    }
    for (const InstructionSet set : supported_sets()) {
      set_instruction_set(set);
      std::vector<Vec3> forces = before;
      add_langevin_forces(drag, strength, velocities, noise, forces);
      EXPECT_EQ(forces, expected) << set << ' ' << count;
    }
  }
}

TEST(LangevinTest, RefusesWhatDoesNotFit) {
  const std::vector<double> two(2), three(3);
  const std::vector<Vec3> two_vectors(2), three_vectors(3);
  std::vector<Vec3> forces(3);
  EXPECT_THROW(uniform_noise(1, 1, {}, forces), InvalidParameter);
  for (const int seed : {0, -1, 900000001}) EXPECT_THROW(RanmarNoise{seed}, InvalidParameter);
  EXPECT_THROW(add_langevin_forces(two, three, three_vectors, three_vectors, forces), InvalidParameter);
  EXPECT_THROW(add_langevin_forces(three, two, three_vectors, three_vectors, forces), InvalidParameter);
  EXPECT_THROW(add_langevin_forces(three, three, two_vectors, three_vectors, forces), InvalidParameter);
  EXPECT_THROW(add_langevin_forces(three, three, three_vectors, two_vectors, forces), InvalidParameter);
}

}  // namespace
}  // namespace dch
