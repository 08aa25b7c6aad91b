// SPDX-License-Identifier: MIT
//
// The limits of the integers that lists are made with: they leave no pair out, and are as near to the cutoff
// as what is rounded on the way allows. What that is, list_kernels.hpp says.
#include "lists/list_limits.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace dch::detail {
namespace {

constexpr double kScale = 32768;  ///< of squares
constexpr double kDigits = 2e-6;  ///< what the last digits of these sums may matter

/// How far a distance by integers may be off [units]: two points and a shift along each axis, floats, and
/// twice the error of distances, once of the pair and once in the largest distance that a filter looks at.
double off_of(double unit, double error, double shift_error = 0.5) {
  return (1 + shift_error) * std::sqrt(3.0) + 0.05 + 2 * error / unit;
}
/// The same of a sum of squares, of which three are rounded, for distances up to `length` [units].
double band_of(double length, double off) { return (2 * off * length + off * off) / kScale + 1.5; }
double square_of(double length) { return length * length / kScale; }
double in_range(double limit) { return std::clamp(limit, 0.0, 32767.0); }

/// That pairs below `in` are within `length`, all within it below `out`, and neither limit is farther from
/// that than one step of the integers.
void expect_limits(std::int16_t in, std::int16_t out, double length, double off) {
  const double inside = square_of(length) - band_of(length, off);
  const double outside = square_of(length) + band_of(length, off);
  EXPECT_LE(in, in_range(inside + 1)) << length;
  EXPECT_GE(in, in_range(inside - kDigits)) << length;
  EXPECT_GE(out, in_range(outside)) << length;
  EXPECT_LE(out, in_range(outside + 1 + kDigits)) << length;
}

/// Those of a filter of two points in open space.
ListLimits limits_of(const ListParams& params, double unit, double error, double reach = 1e300,
                     double shift_error = 0.5) {
  static const std::vector<Vec3> points(40);
  return ListLimits(PairFilter(points, Box::none(), params, error), unit, reach, error, shift_error);
}

/// Calls f(length [units], unit, error [length]) for many of them.
template <class F>
void for_many_lengths(const F& f) {
  for (const double unit : {1.0, 0.0371})
    for (const double error : {0.0, 30 * unit})
      for (double length = 101.7; length < 32700; length += 77.77) f(length, unit, error);
}

TEST(ListLimits, NarrowerWhereShiftsAreNearlyExact) {
  for_many_lengths([](double length, double unit, double error) {
    ListParams params;
    params.cutoffs = TypeCutoffs(length * unit);
    for (const double shift_error : {0.0, 0.07, 0.3}) {
      const ListLimits limits = limits_of(params, unit, error, 1e300, shift_error);
      const double off = off_of(unit, error, shift_error);
      expect_limits(limits.all.in, limits.all.out, length + error / unit, off);
      EXPECT_NEAR(limits.off, off, 1e-9);
    }
  });
}

// What is taken up to its reach has the limit and the margin of a superset with one cutoff.
TEST(ListLimits, OfAReach) {
  for_many_lengths([](double length, double unit, double error) {
    if (error > 0) return;
    ListParams params;
    params.cutoffs = TypeCutoffs(length * unit);
    for (const double shift_error : {0.0, 0.3}) {
      const ListLimits limits = limits_of(params, unit, 0, 1e300, shift_error);
      const ReachLimit of_reach = limit_of_reach(length * unit, unit, shift_error);
      EXPECT_EQ(of_reach.out, limits.all.out) << length;
      EXPECT_NEAR(of_reach.margin, limits.margin, 1e-9 * unit) << length;
    }
  });
}

TEST(ListLimits, OfOneCutoff) {
  for_many_lengths([](double length, double unit, double error) {
    ListParams params;
    params.skin = 0.1 * length * unit;
    params.cutoffs = TypeCutoffs(length * unit - params.skin);
    params.shell = 0.05 * length * unit;
    const ListLimits limits = limits_of(params, unit, error);
    const double off = off_of(unit, error), largest = length + error / unit;
    expect_limits(limits.all.in, limits.all.out, largest, off);
    EXPECT_NEAR(limits.near.in, in_range(square_of(largest - 0.05 * length)), 0.5 + kDigits);
    EXPECT_EQ(limits.near.out, limits.near.in) << "nothing is left open";
    EXPECT_TRUE(limits.has_shell);
    EXPECT_FALSE(limits.per_pair);
    EXPECT_NEAR(limits.cutoff, largest, 1e-9 * largest);
    EXPECT_NEAR(limits.off, off, 1e-9);
    const RowLimits rows = limits.for_rows(limits.all, false), open = limits.for_rows(limits.all, true);
    EXPECT_LE(rows.middle - rows.band, limits.all.in);
    EXPECT_GE(rows.middle + rows.band, limits.all.out);
    EXPECT_LE(2 * rows.band, limits.all.out - limits.all.in + 1);
    EXPECT_EQ(open.middle, limits.all.out);
    EXPECT_EQ(open.band, 0);
    if (limits.all.out == 32767) return;
    // The farthest whose sum of squares can be below `out`, which is rounded by 3/2.
    const double farthest = off + std::sqrt((limits.all.out + 0.5) * kScale);
    EXPECT_GE(limits.margin / unit, farthest - largest);
    EXPECT_LE(limits.margin / unit, farthest - largest + 0.01);
  });
}

TEST(ListLimits, ShellsWiderThanTheCutoffLeaveNoPairNear) {
  ListParams params;
  params.shell = 5;
  EXPECT_EQ(limits_of(params, 0.001, 0).near.in, 0);
  params.shell = 0;
  EXPECT_FALSE(limits_of(params, 0.001, 0).has_shell);
}

TEST(ListLimits, OfTypes) {
  const std::vector<std::int32_t> types(40);
  for_many_lengths([&](double length, double unit, double error) {
    const double a = 0.8 * length * unit, b = 0.3 * length * unit, c = 0.01 * length * unit;
    ListParams params;
    params.types = types;
    params.skin = 0.1 * length * unit;
    params.shell = 0.05 * length * unit;
    params.cutoffs = TypeCutoffs(4, {b, a, 0, 0, a, 0, c, 0, 0, c, b, 0, 0, 0, 0, 0});
    const ListLimits limits = limits_of(params, unit, error);
    const double off = off_of(unit, error);
    EXPECT_FALSE(limits.per_pair);
    EXPECT_NEAR(limits.off, off, 1e-9);
    double margin = 0;
    for (int s = 0; s < 4; ++s) {
      std::int16_t farthest = 1;
      for (int t = 0; t < 4; ++t) {
        const std::int16_t in = limits.all.type_in[s].limit[t], out = limits.all.type_out[s].limit[t];
        EXPECT_EQ(limits.near.type_out[s].limit[t], limits.near.type_in[s].limit[t]);
        const RowLimits rows = limits.for_rows(limits.all, false);
        const int middle = rows.by_type[s].limit[t];
        EXPECT_EQ(limits.for_rows(limits.all, true).by_type[s].limit[t], out);
        EXPECT_EQ(limits.for_rows(limits.all, true).band, 0);
        if (params.cutoffs(s, t) == 0) {
          EXPECT_LT(middle + rows.band, 0) << "nor left open";
          EXPECT_EQ(out, 0) << "no pair of such types is listed";
          EXPECT_EQ(limits.near.type_in[s].limit[t], 0);
          continue;
        }
        const double reach = (params.cutoffs(s, t) + params.skin) / unit;
        expect_limits(in, out, reach, off);
        EXPECT_LE(middle - rows.band, in);
        EXPECT_GE(middle + rows.band, out);
        EXPECT_NEAR(limits.type_cutoff[s][t], reach, 1e-9 * reach);
        EXPECT_NEAR(limits.near.type_in[s].limit[t], in_range(square_of(reach - 0.05 * length)),
                    0.5 + kDigits);
        farthest = std::max(farthest, out);
        margin = std::max(margin, off + std::sqrt((out + 0.5) * kScale) - reach);
      }
      EXPECT_EQ(limits.farthest.limit[s], farthest) << "the widest of a type";
    }
    if (length > 32500) return;
    EXPECT_GE(limits.margin / unit, margin);
    EXPECT_LE(limits.margin / unit, margin + 0.01);
  });
}

TEST(ListLimits, MoreTypesThanKernelsTellApartGoByTheLargestCutoff) {
  const std::vector<std::int32_t> types(40);
  for (const int count : {kKernelTypes, kKernelTypes + 1}) {
    ListParams params;
    params.types = types;
    params.shell = 0.5;
    params.cutoffs = TypeCutoffs(count, std::vector<double>(static_cast<std::size_t>(count) * count, 2.0));
    const ListLimits limits = limits_of(params, 0.001, 0);
    EXPECT_EQ(limits.per_pair, count > kKernelTypes);
    EXPECT_EQ(limits.all.type_out.empty(), limits.per_pair);
    if (!limits.per_pair) continue;
    EXPECT_EQ(limits.all.in, 0);
    EXPECT_GE(limits.all.out, square_of(2000) + band_of(2000, off_of(0.001, 0)));
    EXPECT_LE(limits.all.out, square_of(2000) + band_of(2000, off_of(0.001, 0)) + 1 + kDigits);
    EXPECT_NEAR(limits.near.in, square_of(1500), 0.5);
    EXPECT_EQ(limits.near.out, limits.near.in);
  }
}

TEST(ListLimits, OfRadii) {
  constexpr double kSizes = 1.51;  // two radii and the skin, and floats
  for_many_lengths([&](double length, double unit, double error) {
    for (const double reach : {0.4, 2.0}) {
      std::vector<double> radii(40, 0.05 * length * unit);
      radii.back() = 0.4 * length * unit;
      ListParams params;
      params.radii = radii;
      params.skin = 0.2 * length * unit;
      params.shell = 0.05 * length * unit;
      const ListLimits limits = limits_of(params, unit, error, reach * length * unit);
      const double off = off_of(unit, error);
      const double farthest = std::min(length + error / unit, reach * length);
      const double band = band_of(farthest, off) + (2 * kSizes * farthest + kSizes * kSizes) / kScale + 0.5;
      EXPECT_GE(limits.all.band, band);
      EXPECT_LE(limits.all.band, band + 1 + kDigits);
      EXPECT_NEAR(limits.all.skin, 0.2 * length, 0.5);
      EXPECT_NEAR(limits.near.skin, 0.15 * length, 0.5);
      EXPECT_EQ(limits.near.band, 0);
      const RowLimits rows = limits.for_rows(limits.all, false), open = limits.for_rows(limits.all, true);
      EXPECT_EQ(rows.skin, limits.all.skin);
      EXPECT_EQ(rows.band, limits.all.band);
      EXPECT_EQ(rows.raise, 0);
      EXPECT_EQ(open.raise, limits.all.band);
      EXPECT_EQ(open.band, 0);
      EXPECT_NEAR(limits.off, off + kSizes, 1e-9);
      for (double pair = 0.3 * length; pair <= farthest; pair += 0.05 * length) {
        const double size = pair + kSizes;
        // Sums below square + band: at most one less, and 1/2 and 3/2 more before they are rounded.
        const double beyond = off + std::sqrt((square_of(size) + 1 + limits.all.band) * kScale) - pair;
        EXPECT_GE(limits.margin / unit, beyond) << "pairs of " << pair;
        if (pair > 0.3 * length) continue;
        EXPECT_LE(limits.margin / unit, beyond + 0.01) << "the smallest pairs";
      }
    }
  });
}

// At lengths where a sum lies just above a whole number, so that the least part of it counts, down to the
// room for the last digits of these sums.
TEST(ListLimits, LeaveNothingOfTheirErrorsOut) {
  constexpr double kSizes = 1.51, kRoom = 1e-6;
  const double off = off_of(1, 0);
  for (int steps = 100; steps < 30000; steps += 997) {
    ListParams params;  // (L^2 + 2 off L + off^2) / S + 3/2 is whole but for half of that room
    params.cutoffs = TypeCutoffs(std::sqrt(kScale * (steps - 1.5 - kRoom / 2)) - off);
    EXPECT_EQ(limits_of(params, 1, 0).all.out, steps + 1);
  }
  for (int steps = 3; steps < 10; ++steps) {
    // (2 off L + off^2) / S + 3/2 + (2 sizes L + sizes^2) / S + 1/2 is whole but for a small part of sizes^2
    // / S.
    const double missing = 0.1 * kSizes * kSizes / kScale;
    const double length =
        (kScale * (steps + missing - 2 - kRoom) - off * off - kSizes * kSizes) / (2 * (off + kSizes));
    const std::vector<double> radii(40, 0.5 * length);
    ListParams params;
    params.radii = radii;
    EXPECT_EQ(limits_of(params, 1, 0).all.band, steps + 1);
  }
}

}  // namespace
}  // namespace dch::detail
