// SPDX-License-Identifier: MIT
//
// Embedded atoms equal a plain loop over all pairs, in long double. Functions are cubics, which pieces of
// cubics with slopes of fourth order follow exactly but beside their ends, so that no piece is computed here.
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/forces/embedded_atoms.hpp>

#include "instruction_sets.hpp"
#include "lj_oracle.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kCutoff = 1.5, kStep = 0.01, kDensityStep = 0.25;
constexpr int kDistances = 200, kDensities = 2000;

struct Function {
  long double a, b, c, d;
  long double at(long double x) const { return a + x * (b + x * (c + x * d)); }
  long double slope(long double x) const { return b + x * (2 * c + x * 3 * d); }
  std::vector<double> values(int count, double step) const {
    std::vector<double> all;
    for (int k = 0; k < count; ++k)
      all.push_back(static_cast<double>(at(k * static_cast<long double>(step))));
    return all;
  }
};

/// Functions of all types, which differ or are all alike.
struct Functions {
  int types;
  bool alike;

  Function density(int first, int second) const {
    const int kind = alike ? 0 : first + 2 * second;
    return {0.9L, -0.4L + 0.1L * kind, 0.05L, -0.02L * kind};
  }
  Function pair(int first, int second) const {
    const int kind = alike ? 0 : first + second;
    return {1.3L, -0.7L, 0.2L * kind, 0.11L};
  }
  Function embedding(int type) const { return {0.1L * type, -0.5L, 0.02L, 0.0001L * type}; }

  EmbeddedAtomParams params() const {
    EmbeddedAtomParams all;
    all.types = types;
    all.cutoff = kCutoff;
    all.distance_step = kStep;
    all.density_step = kDensityStep;
    for (int a = 0; a < types; ++a) {
      all.embeddings.push_back(embedding(a).values(kDensities, kDensityStep));
      for (int b = 0; b < types; ++b) {
        all.densities.push_back(density(a, b).values(kDistances, kStep));
        all.pairs.push_back(pair(a, b).values(kDistances, kStep));
      }
    }
    return all;
  }
};

/// Atoms with a half list of all pairs, in rows with bits beside the numbers.
struct Atoms {
  std::vector<Vec3> positions;
  std::vector<std::int32_t> types, with_rows, counts;
  std::vector<std::vector<std::int32_t>> rows;
  std::vector<const std::int32_t*> first;

  Atoms(std::size_t count, double radius, int kinds) {
    scenes::Random random(11);
    for (std::size_t k = 0; k < count; ++k) {
      positions.push_back(random.in_ball(radius));
      while (is_near_another()) positions.back() = random.in_ball(radius);
      types.push_back(1 + static_cast<std::int32_t>(k) % kinds);
      with_rows.push_back(static_cast<std::int32_t>(count - 1 - k));
    }
    rows.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j)
        rows[i].push_back(static_cast<std::int32_t>(j) | static_cast<std::int32_t>(j % 2 << 30));
    for (const auto& row : rows) {
      counts.push_back(static_cast<std::int32_t>(row.size()));
      first.push_back(row.data());
    }
  }
  /// Cubics are not followed beside the first value.
  bool is_near_another() const {
    for (std::size_t k = 0; k + 1 < positions.size(); ++k)
      if (norm2(positions[k] - positions.back()) < 9 * kStep * kStep) return true;
    return false;
  }
  NeighborRows list() const { return {with_rows, counts.data(), first.data(), (1 << 30) - 1}; }
};

struct Outcome {
  std::vector<double> densities, slopes;
  std::vector<Vec3> forces;
  double energy = 0;
};

Outcome plain(const Atoms& atoms, const Functions& functions) {
  const std::size_t n = atoms.positions.size();
  std::vector<long double> densities(n, 1), slopes(n);
  std::vector<std::array<long double, 3>> forces(n);
  long double energy = 0;
  const auto for_each = [&](const auto& visit) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) {
        const Vec3 &p = atoms.positions[i], &q = atoms.positions[j];
        const std::array<long double, 3> d{static_cast<long double>(p.x) - q.x,
                                           static_cast<long double>(p.y) - q.y,
                                           static_cast<long double>(p.z) - q.z};
        const long double r = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        if (r < kCutoff) visit(i, j, d, r, atoms.types[i] - 1, atoms.types[j] - 1);
      }
  };
  for_each([&](std::size_t i, std::size_t j, const auto&, long double r, int a, int b) {
    densities[i] += functions.density(a, b).at(r);
    densities[j] += functions.density(b, a).at(r);
  });
  for (std::size_t i = 0; i < n; ++i) slopes[i] = functions.embedding(atoms.types[i] - 1).slope(densities[i]);
  for_each([&](std::size_t i, std::size_t j, const auto& d, long double r, int a, int b) {
    const Function pair = functions.pair(a, b);
    energy += pair.at(r) / r;
    const long double slope = slopes[i] * functions.density(a, b).slope(r) +
                              slopes[j] * functions.density(b, a).slope(r) + pair.slope(r) / r -
                              pair.at(r) / (r * r);
    for (int axis = 0; axis < 3; ++axis) {
      forces[i][axis] -= slope / r * d[axis];
      forces[j][axis] += slope / r * d[axis];
    }
  });
  Outcome all;
  all.energy = static_cast<double>(energy);
  for (std::size_t i = 0; i < n; ++i) {
    all.densities.push_back(static_cast<double>(densities[i]));
    all.slopes.push_back(static_cast<double>(slopes[i]));
    all.forces.push_back({static_cast<double>(forces[i][0]), static_cast<double>(forces[i][1]),
                          static_cast<double>(forces[i][2])});
  }
  return all;
}

Outcome ours(const Atoms& atoms, EmbeddedAtoms& embedded, const EmbeddedAtoms::PairVisitor& visit = {}) {
  const std::size_t n = atoms.positions.size();
  Outcome all{std::vector<double>(n, 1.0), {}, std::vector<Vec3>(n), 0};
  embedded.add_densities(atoms.list(), atoms.positions, atoms.types, all.densities);
  for (std::size_t i = 0; i < n; ++i)
    all.slopes.push_back(embedded.embedding(atoms.types[i], all.densities[i]).slope);
  all.energy = embedded.add_forces(atoms.list(), atoms.types, all.slopes, all.forces, visit);
  return all;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    worst = std::max(worst, std::abs(a[k] - b[k]) / (1 + std::abs(b[k])));
  return worst;
}

TEST(EmbeddedAtomsTest, EqualAPlainLoop) {
  const RestoreInstructionSet restore;
  for (const Functions& functions : {Functions{1, true}, Functions{3, true}, Functions{3, false}})
    for (const std::size_t count : {1u, 2u, 3u, 8u, 9u, 10u, 17u, 60u, 700u}) {
      const Atoms atoms(count, count < 20 ? 0.9 : 2.0, functions.types);
      const Outcome expected = plain(atoms, functions);
      for (const InstructionSet set : supported_sets()) {
        set_instruction_set(set);
        EmbeddedAtoms embedded(functions.params());
        for (int again = 0; again < 2; ++again) {
          const Outcome found = ours(atoms, embedded);
          EXPECT_LT(largest_difference(found.densities, expected.densities), 1e-12) << name(set) << count;
          EXPECT_LT(largest_difference(found.slopes, expected.slopes), 1e-10) << name(set) << count;
          EXPECT_LT(std::abs(found.energy - expected.energy), 1e-11 * (1 + std::abs(expected.energy)))
              << name(set) << count;
          if (count > 1) {
            EXPECT_LT(force_error(found.forces, expected.forces), 1e-10) << name(set) << count;
          }
        }
      }
    }
}

TEST(EmbeddedAtomsTest, ShowTheirPairs) {
  const RestoreInstructionSet restore;
  const Functions functions{2, false};
  const Atoms atoms(80, 1.6, 2);
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    EmbeddedAtoms embedded(functions.params());
    std::vector<Vec3> forces(80);
    std::vector<std::int32_t> pairs(80);
    double energy = 0;
    Outcome found = ours(atoms, embedded, [&](Span<const EmbeddedPair> row) {
      for (const EmbeddedPair& pair : row) {
        const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
        EXPECT_EQ(pair.from_j_to_i, atoms.positions[i] - atoms.positions[j]);
        forces[i] = forces[i] + pair.force_over_r * pair.from_j_to_i;
        forces[j] = forces[j] - pair.force_over_r * pair.from_j_to_i;
        energy += pair.energy;
        ++pairs[i];
      }
    });
    EXPECT_LT(force_error(forces, found.forces), 1e-13) << name(set);
    EXPECT_NEAR(energy, found.energy, 1e-12 * std::abs(energy)) << name(set);
    for (std::int32_t k = 0; k < 80; ++k) EXPECT_EQ(embedded.pairs_of(k), pairs[static_cast<std::size_t>(k)]);
  }
}

TEST(EmbeddedAtomsTest, TellFunctionsOfAPair) {
  const Functions functions{2, false};
  const EmbeddedAtoms embedded(functions.params());
  const double r = 1.237;
  const EmbeddedAtoms::OfPair found = embedded.of_pair(1, 2, r);
  const Function pair = functions.pair(0, 1);
  EXPECT_NEAR(found.energy, static_cast<double>(pair.at(r) / r), 1e-13);
  EXPECT_NEAR(found.slope,
              static_cast<double>(pair.slope(r) / r - pair.at(r) / (r * static_cast<long double>(r))), 1e-11);
  EXPECT_NEAR(found.slope_of_density_of_first, static_cast<double>(functions.density(0, 1).slope(r)), 1e-11);
  EXPECT_NEAR(found.slope_of_density_of_second, static_cast<double>(functions.density(1, 0).slope(r)), 1e-11);
}

/// Beyond the last value energies go on in a line, and functions of distances stay.
TEST(EmbeddedAtomsTest, GoOnBeyondTheLastValue) {
  EmbeddedAtomParams params = Functions{1, true}.params();
  params.cutoff = 3;
  EmbeddedAtoms embedded(params);
  const double last = (kDensities - 1) * kDensityStep;
  const EmbeddedAtoms::Embedding at = embedded.embedding(1, last), beyond = embedded.embedding(1, last + 7);
  EXPECT_NEAR(at.energy, params.embeddings[0].back(), 1e-12 * std::abs(at.energy));
  EXPECT_EQ(beyond.slope, at.slope);
  EXPECT_NEAR(beyond.energy, at.energy + 7 * at.slope, 1e-12 * std::abs(beyond.energy));
  params.line_from = last + 2;
  EXPECT_NEAR(EmbeddedAtoms(params).embedding(1, last + 1).energy, at.energy, 1e-12 * std::abs(at.energy));
  EXPECT_NEAR(EmbeddedAtoms(params).embedding(1, last + 7).energy, at.energy + 5 * at.slope,
              1e-12 * std::abs(beyond.energy));
  const RestoreInstructionSet restore;
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    const std::int32_t atom = 0, neighbor = 1, counts[] = {1, 0};
    const std::int32_t* const rows[] = {&neighbor, nullptr};
    const std::vector<Vec3> positions = {{0, 0, 0}, {0, 2.7, 0}};
    const std::vector<std::int32_t> types = {1, 1};
    std::vector<double> densities(2);
    embedded.add_densities({{&atom, 1}, counts, rows}, positions, types, densities);
    EXPECT_NEAR(densities[0], params.densities[0].back(), 1e-13) << name(set);
    EXPECT_EQ(densities[0], densities[1]) << name(set);
  }
}

TEST(EmbeddedAtomsTest, RefuseWhatDoesNotFit) {
  const Functions functions{2, false};
  const auto expect_refused = [&](const auto& change) {
    EmbeddedAtomParams params = functions.params();
    change(params);
    EXPECT_THROW(EmbeddedAtoms{params}, InvalidParameter);
  };
  expect_refused([](EmbeddedAtomParams& p) { p.types = 0; });
  expect_refused([](EmbeddedAtomParams& p) { p.cutoff = -1; });
  expect_refused([](EmbeddedAtomParams& p) { p.distance_step = std::numeric_limits<double>::quiet_NaN(); });
  expect_refused([](EmbeddedAtomParams& p) { p.density_step = 0; });
  expect_refused([](EmbeddedAtomParams& p) { p.densities.pop_back(); });
  expect_refused([](EmbeddedAtomParams& p) { p.pairs[1].pop_back(); });
  expect_refused([](EmbeddedAtomParams& p) { p.embeddings.assign(2, {1, 2, 3, 4}); });
  expect_refused([](EmbeddedAtomParams& p) {
    for (auto& values : p.pairs) values.pop_back();
  });
  Atoms atoms(5, 1, 2);
  EmbeddedAtoms embedded(functions.params());
  std::vector<double> densities(5);
  std::vector<Vec3> forces(4);
  EXPECT_THROW(embedded.add_densities(atoms.list(), atoms.positions, {atoms.types.data(), 4}, densities),
               InvalidParameter);
  EXPECT_THROW(embedded.add_densities(atoms.list(), atoms.positions, atoms.types, {densities.data(), 4}),
               InvalidParameter);
  embedded.add_densities(atoms.list(), atoms.positions, atoms.types, densities);
  EXPECT_THROW(embedded.add_forces(atoms.list(), atoms.types, densities, forces), InvalidParameter);
  EXPECT_THROW(embedded.add_forces(atoms.list(), atoms.types, {densities.data(), 4}, {forces.data(), 4}),
               InvalidParameter);
}

}  // namespace
}  // namespace dch
