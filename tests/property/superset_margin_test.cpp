// SPDX-License-Identifier: MIT
//
// Supersets in every kind of box and scene: they lack no pair, hold none beyond their margin, and their
// margin is no wider than what integers of 16 bits leave open.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <dch/lists/all_pairs.hpp>

#include "effort.hpp"
#include "geometry/position_check.hpp"
#include "size_models.hpp"

namespace dch {
namespace {

using namespace sizes;  // NOLINT(google-build-using-namespace)

constexpr double kSquares = 32768;  ///< squares of integers are divided by this and rounded
constexpr double kSpan = 32700;     ///< integers that the largest difference of coordinates has
constexpr double kDigits = 1e-5;    ///< what widths in single precision and the last digits may matter

/// What the kernels round, in the unit u of the coordinates. A distance is off by `off`: along each axis two
/// points and a shift, 1/2 each, that is sqrt(3) 3/2; a little for floats; and twice the error e of distances
/// by wrapped positions. The square of a distance is a sum t of three squares, each of which is rounded to
/// S = 2^15 u^2, so it is off by 3/2 S.
///
/// A pair is kept if S t <= (l + off)^2 + 3/2 S, which lets in all pairs within their reach l. Hence one that
/// is kept has (d - off)^2 <= (l + off)^2 + 3 S.
/// Where reaches are sums of radii, l is off by s = 3/2 (two radii and the skin) and a little, its square by
/// 1/2 S, and one band serves all pairs up to the longest reach f: it is (f + off)^2 - f^2 + 3/2 S for
/// distances and (f + s)^2 - f^2 + 1/2 S for reaches.
struct Rounding {
  double unit, error;  ///< [length]
  double off() const { return 1.5 * std::sqrt(3.0) + 0.05 + 2 * error / unit; }
  /// How far beyond its reach a kept pair may be [length].
  double margin(double reach) const {
    const double l = reach / unit;
    return (off() + std::sqrt((l + off()) * (l + off()) + 3 * kSquares) - l) * unit;
  }
  double margin_by_radii(double reach, double farthest) const {
    constexpr double kSizes = 1.51;
    const double l = reach / unit, f = farthest / unit;
    const double band = 2 * (off() + kSizes) * f + off() * off() + kSizes * kSizes + 2 * kSquares;
    return (off() + std::sqrt((l + kSizes) * (l + kSizes) + band + 2 * kSquares) - l) * unit;
  }
};

/// Of the pairs that are listed: the shorter, the more its margin.
double shortest_reach(const SizeModel& model) {
  if (!model.radii.empty()) return kSkin + 2 * *std::min_element(model.radii.begin(), model.radii.end());
  double shortest = std::numeric_limits<double>::infinity();
  for (int a = 0; a < model.cutoffs.types(); ++a)
    for (int b = 0; b < model.cutoffs.types(); ++b)
      if (model.cutoffs(a, b) > 0) shortest = std::min(shortest, model.cutoffs(a, b) + kSkin);
  return shortest;
}

/// The largest difference of coordinates that an engine may have to tell: from a point of a leaf as far as
/// the reach and one block farther. A leaf lies within R_0 of its center, so is 2 R_0 wide, its blocks too;
/// and R_0 is at most four radii of the search. Cells of the grid are made so narrow that five reaches do for
/// pairs of one class, and six for two.
double widest_difference(PairSearch& search, double reach) {
  const std::vector<LevelInfo> levels = search.levels();
  const double base = levels.empty() ? 4 * kReach : levels.front().covering_radius;
  return reach + 3 * base;
}

double largest_margin(PairSearch& search, const SizeModel& model, const std::vector<Vec3>& points,
                      const Box& box) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const double error =
      detail::WrapError(box).bound(detail::check_positions(points, box)) + 64 * kEpsilon * kReach;
  const double farthest = model.params().list_radius() + 2 * error;
  const Rounding rounding{widest_difference(search, farthest) / kSpan, error};
  const double shortest = shortest_reach(model);
  return (1 + kDigits) *
         (model.radii.empty() ? rounding.margin(shortest) : rounding.margin_by_radii(shortest, farthest));
}

class Supersets : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(Supersets, LackNoPairAndKeepToTheirMargin) {
  const Box box = GetParam().box;
  for (const scenes::NamedPoints& scene : scenes::hard_point_sets(box, effort(400), 0.6)) {
    for (const SizeModel& model : size_models(scene.points.size())) {
      ListParams params = model.params();
      const NeighborList least = all_pairs(scene.points, box, params);
      params.superset = true;
      for (const Engine engine : kEngines) {
        const auto search = search_with(engine);
        search->update(scene.points, box);
        const NeighborList list = search->list(params);
        ASSERT_GE(list.margin, 0);
        ASSERT_LE(list.margin, largest_margin(*search, model, scene.points, box))
            << scene.name << ", " << model.name << text(engine);
        for (std::size_t i = 0; i < scene.points.size(); ++i) {
          const auto row = list.row(i), needed = least.row(i);
          ASSERT_TRUE(std::includes(row.begin(), row.end(), needed.begin(), needed.end()))
              << scene.name << ", " << model.name << ", row " << i;
          for (const std::int32_t j : row) {
            const double distance = std::sqrt(norm2(box.nearest_image(scene.points[j] - scene.points[i])));
            ASSERT_LE(distance, model.reach(i, static_cast<std::size_t>(j)) + list.margin)
                << scene.name << ", " << model.name << ", pair " << i << ", " << j;
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, Supersets, ::testing::ValuesIn(scenes::all_boxes(kSide)),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace dch
