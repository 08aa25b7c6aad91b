// SPDX-License-Identifier: GPL-2.0-or-later
#include "table_knots.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

namespace dch::lammps {
namespace {

/// A table as LAMMPS keeps one, and what is asked of it. No distance closer than its first one has numbers,
/// nor has its end.
struct Kept {
  PairTable table;
  bool is_spline = true;
  double wrong = 0;  ///< a part of each value that is added in the middles of intervals

  TablePoint at(double r2) const {
    const std::size_t n = table.energy.size();
    const double first = table.inner * table.inner;
    const double apart = (table.outer * table.outer - first) / static_cast<double>(n - 1),
                 along = (r2 - first) / apart;
    const auto k = static_cast<std::size_t>(along);
    if (!(along > -1e-9) || k >= n - 1) throw std::out_of_range("no such distance");
    const double b = (r2 - (first + static_cast<double>(k) * apart)) * (1 / apart), a = 1 - b;
    const auto value = [&](const std::vector<double>& v, const std::vector<double>& bend) {
      const double line = a * v[k] + b * v[k + 1] + (b > 0.4 && b < 0.6 ? wrong * v[k] : 0);
      return is_spline
                 ? line + ((a * a * a - a) * bend[k] + (b * b * b - b) * bend[k + 1]) * (apart * apart / 6)
                 : line;
    };
    return {value(table.energy, table.energy_bend), value(table.force_over_r, table.force_bend)};
  }
};

/// Of a Lennard-Jones potential, with bends near its own, which jump a little from knot to knot.
Kept lennard_jones(double inner, double outer, int knots) {
  Kept kept;
  kept.table.inner = inner;
  kept.table.outer = outer;
  const double apart = (outer * outer - inner * inner) / (knots - 1);
  for (int k = 0; k < knots; ++k) {
    const double s = 1 / (inner * inner + k * apart), s3 = s * s * s, jump = 1 + 0.01 * (k % 3);
    kept.table.energy.push_back(4 * (s3 * s3 - s3));
    kept.table.force_over_r.push_back(24 * s * (2 * s3 * s3 - s3));
    kept.table.energy_bend.push_back(jump * 4 * (42 * s3 * s3 - 12 * s3) * s * s);
    kept.table.force_bend.push_back(jump * 24 * (112 * s3 * s3 - 20 * s3) * s * s * s);
  }
  return kept;
}

bool take(const Kept& kept, double inner, double outer, int knots, PairTable& found) {
  found.inner = inner;
  found.outer = outer;
  const AskTable ask = [&](double r2) { return kept.at(r2); };
  return kept.is_spline ? take_splines(ask, knots, found) : take_lines(ask, knots, found);
}

/// Beside what the table has at one place and next to it, where it has been asked.
TEST(TableKnots, SplinesAreFoundAgain) {
  for (const int knots : {2, 3, 4, 17, 300, 5000, 200000}) {
    const Kept kept = lennard_jones(0.7, 2.5, knots);
    Kept again;
    ASSERT_TRUE(take(kept, 0.7, 2.5, knots, again.table)) << knots;
    const double apart = (6.25 - 0.49) / (knots - 1), rounding = 1e-15 * knots;
    for (int k = 0; k < 10000; ++k) {
      const double r2 = 0.49 + (6.25 - 0.49) * (k + 0.3) / 10000;
      const TablePoint expected = kept.at(r2), found = again.at(r2);
      double energies[2] = {0, 1e-9}, forces[2] = {0, 1e-9};  // largest difference, largest value
      const double first = 0.49 + std::floor((r2 - 0.49) / apart) * apart;
      for (int part = 1; part < 16; ++part) {
        const TablePoint near = kept.at(first + 0.0625 * part * apart);
        energies[0] = std::max(energies[0], std::abs(near.energy - expected.energy));
        energies[1] = std::max(energies[1], std::abs(near.energy));
        forces[0] = std::max(forces[0], std::abs(near.force_over_r - expected.force_over_r));
        forces[1] = std::max(forces[1], std::abs(near.force_over_r));
      }
      EXPECT_NEAR(found.energy, expected.energy, rounding * energies[0] + 1e-14 * energies[1])
          << knots << ", " << r2;
      EXPECT_NEAR(found.force_over_r, expected.force_over_r, rounding * forces[0] + 1e-14 * forces[1])
          << knots << ", " << r2;
    }
  }
}

TEST(TableKnots, LinesAreFoundAgain) {
  Kept kept = lennard_jones(0.7, 2.5, 1000);
  kept.is_spline = false;
  PairTable found;
  ASSERT_TRUE(take(kept, 0.7, 2.5, 1000, found));
  EXPECT_TRUE(found.energy_bend.empty() && found.force_bend.empty());
  for (std::size_t k = 0; k < found.energy.size(); ++k) {
    EXPECT_NEAR(found.energy[k], kept.table.energy[k], 1e-11 * (1 + std::abs(kept.table.energy[k])));
    EXPECT_NEAR(found.force_over_r[k], kept.table.force_over_r[k],
                1e-11 * (1 + std::abs(kept.table.force_over_r[k])));
  }
}

/// Before it is asked for a distance that it does not have.
TEST(TableKnots, KnotsElsewhereAreNotTaken) {
  for (const bool is_spline : {true, false}) {
    Kept kept = lennard_jones(0.7, 2.5, 300);
    kept.is_spline = is_spline;
    PairTable found;
    EXPECT_TRUE(take(kept, 0.7, 2.5, 300, found));
    for (const double inner : {0.6, 0.699, 0.701, 0.8, 1.5})
      EXPECT_FALSE(take(kept, inner, 2.5, 300, found)) << inner;
    for (const int knots : {299, 301, 150, 600}) EXPECT_FALSE(take(kept, 0.7, 2.5, knots, found)) << knots;
    EXPECT_FALSE(take(kept, 0.7, 2.49, 300, found));
  }
}

TEST(TableKnots, AnotherFormIsNotTaken) {
  PairTable found;
  Kept kept = lennard_jones(0.7, 2.5, 300);
  for (const double wrong : {1e-12, -1e-12, 1e-3}) {
    kept.wrong = wrong;
    EXPECT_FALSE(take(kept, 0.7, 2.5, 300, found)) << wrong;
  }
  kept = lennard_jones(0.7, 2.5, 300);
  kept.is_spline = false;
  const AskTable lines = [&](double r2) { return kept.at(r2); };
  EXPECT_TRUE(take_splines(lines, 300, found));  // a line is a cubic, and these have no bends
  for (const double bend : found.energy_bend) EXPECT_NEAR(bend, 0, 1e-3);
  kept.is_spline = true;
  const AskTable splines = [&](double r2) { return kept.at(r2); };
  EXPECT_FALSE(take_lines(splines, 300, found));
  // Second derivatives that jump at a knot, as those of cubics that are no spline do.
  const AskTable jumping = [&](double r2) {
    const double along = (r2 - 0.49) / (6.25 - 0.49) * 299, b = along - std::floor(along);
    return TablePoint{b * b * (1 - b), 1};
  };
  EXPECT_FALSE(take_splines(jumping, 300, found));
  const AskTable steps = [](double r2) {
    return TablePoint{1, std::floor((r2 - 0.49) / (6.25 - 0.49) * 299)};
  };
  EXPECT_FALSE(take_splines(steps, 300, found));
}

}  // namespace
}  // namespace dch::lammps
