// SPDX-License-Identifier: MIT
//
// How the grid takes points: their cells, the order within these, and lists from them when things change
// between the positions and the request.
#include "grid/cell_layer.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "error_message.hpp"
#include "grid/cell_bins.hpp"
#include "grid/cell_curve.hpp"
#include "instruction_sets.hpp"
#include "list_compare.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

using detail::CellBins;
using detail::CellCoordinates;
using detail::CellCurve;
using detail::CellLayer;
using detail::CellLayout;
using detail::CellRounding;
using detail::RoundedPoint;
using ::testing::HasSubstr;

TEST(CellCurve, GoesThroughEveryPieceToOneBesideIt) {
  for (int halvings = 0; halvings <= CellCurve::kBits; ++halvings) {
    const CellCurve curve(halvings);
    const int along = 1 << halvings, drop = CellCurve::kBits - halvings;
    std::vector<CellCoordinates> at(static_cast<std::size_t>(1) << curve.bits(), {-1, -1, -1});
    for (int x = 0; x < along; ++x)
      for (int y = 0; y < along; ++y)
        for (int z = 0; z < along; ++z) {
          const auto place = static_cast<std::size_t>(curve(x << drop, y << drop, z << drop));
          ASSERT_LT(place, at.size());
          ASSERT_EQ(at[place][0], -1) << "two pieces at one place";
          at[place] = {x, y, z};
        }
    for (std::size_t k = 1; k < at.size(); ++k) {
      int steps = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) steps += std::abs(at[k][axis] - at[k - 1][axis]);
      EXPECT_EQ(steps, 1) << k << " of " << at.size();
    }
  }
}

class CellPoints : public ::testing::TestWithParam<scenes::NamedBox> {};

CellLayout layout_of(const std::vector<Vec3>& points, const Box& box, double width) {
  return {points, box, width};
}

// Bit by bit what wrapping, the layout and rounding say point by point, for every number of points, beside
// the box and far outside of it.
TEST_P(CellPoints, AreBinnedAlikeOnEveryInstructionSet) {
  const Box& box = GetParam().box;
  const RestoreInstructionSet restore;
  scenes::Random random(11);
  for (const double away : {2.0, 40.0}) {
    const std::vector<Vec3> points = [&] {
      std::vector<Vec3> some = scenes::uniform_in(box, 21, 12);
      for (Vec3& p : some) p = p + random.in_cube(away);
      return some;
    }();
    const CellLayout layout = layout_of(points, box, 0.7);
    const CellRounding rounding{box.wrap(points[0]), 0.001};
    for (const InstructionSet set : supported_sets()) {
      set_instruction_set(set);
      const CellBins bins(box, layout, rounding);
      for (std::size_t count = 0; count <= points.size(); ++count) {
        std::vector<CellCoordinates> piece(count + 1);
        std::vector<RoundedPoint> rounded(count + 1);
        bins.find({points.data(), count}, piece.data(), rounded.data());
        for (std::size_t k = 0; k < count; ++k) {
          const Vec3 at = box.wrap(points[k]);
          const CellCoordinates cell = layout.coordinates(at);
          for (std::size_t d = 0; d < 3; ++d) {
            const std::int32_t coordinate = piece[k][static_cast<std::size_t>(bins.axis(d))];
            ASSERT_EQ(coordinate, layout.piece_coordinates(at)[d]) << set << ' ' << count << ' ' << k;
            ASSERT_EQ(detail::cell_of(coordinate), cell[d]) << set;
          }
          ASSERT_EQ(rounded[k], detail::CellRounder(rounding)(at)) << set << ' ' << count << ' ' << k;
        }
      }
    }
  }
}

// In cells wide and narrow: an array of all cells, of those around the points, and a table of occupied ones.
TEST_P(CellPoints, StandInTheirCells) {
  const Box& box = GetParam().box;
  for (const double width : {0.3, 0.9, 2.0})
    for (const std::size_t n : {1u, 40u, 700u}) {
      std::vector<Vec3> points = scenes::uniform_in(box, n, 13);
      const CellLayout layout = layout_of(points, box, width);
      const CellRounding rounding{box.wrap(points[0]), 0.001};
      const CellBins bins(box, layout, rounding);
      CellLayer layer;
      ASSERT_TRUE(layer.start(n, box, layout, rounding));
      const std::size_t half = n / 2;  // in parts, as threads do it
      layer.take(bins, {points.data() + half, n - half}, half);
      layer.take(bins, {points.data(), half}, 0);
      ASSERT_TRUE(layer.sort(nullptr));
      ASSERT_EQ(layer.size(), static_cast<std::int32_t>(n));
      std::vector<int> seen(n, 0);
      for (std::int32_t cell = 0; cell < layer.cells(); ++cell) {
        const CellLayer::Run run = layer.points_of(cell);
        for (std::int32_t place = run.begin; place < run.end; ++place) {
          const detail::Candidates point = layer.at(place);
          const auto i = static_cast<std::size_t>(*point.id);
          const Vec3 at = box.wrap(points[i]);
          ++seen[i];
          ASSERT_EQ(layout.coordinates(at), layer.coordinates(cell)) << "width " << width << ", point " << i;
          const RoundedPoint rounded{*point.x, *point.y, *point.z};
          ASSERT_EQ(rounded, detail::CellRounder(rounding)(at));
        }
      }
      for (const int times : seen) ASSERT_EQ(times, 1);
      for (const int shares : {1, 3, 16}) {  // their cells are all cells, and in order
        ASSERT_EQ(layer.first_cell_of_share(0, shares), 0);
        for (int share = 1; share < shares; ++share) {
          const std::int32_t first = layer.first_cell_of_share(share, shares);
          const auto wanted = share_begin(static_cast<std::int32_t>(n), share, shares);
          if (first < layer.cells()) {
            ASSERT_GE(layer.points_of(first).begin, wanted);
          }
          if (first > 0) {
            ASSERT_LT(layer.points_of(first - 1).begin, wanted);
          }
        }
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Boxes, CellPoints, ::testing::ValuesIn(scenes::all_boxes(5)),
                         [](const auto& tested) { return tested.param.name; });

// Eight points that follow each other in a cell fill a small part of it, whatever order they were given in.
TEST(CellOrder, PointsNextToEachOtherAreCloseTogether) {
  const Box box = Box::orthorhombic({10, 10, 10});
  const std::vector<Vec3> points = scenes::uniform_in(box, 8000, 14);
  const CellLayout layout = layout_of(points, box, 1.99);  // 64 points a cell
  const CellRounding rounding{{}, 0.001};
  CellLayer layer;
  ASSERT_TRUE(layer.start(points.size(), box, layout, rounding));
  layer.take(CellBins(box, layout, rounding), points, 0);
  ASSERT_TRUE(layer.sort(nullptr));
  double volume = 0;
  int blocks = 0;
  for (std::int32_t cell = 0; cell < layer.cells(); ++cell) {
    const CellLayer::Run run = layer.points_of(cell);
    for (std::int32_t begin = run.begin; begin + 8 <= run.end; begin += 8, ++blocks) {
      Vec3 low = points[static_cast<std::size_t>(*layer.at(begin).id)], high = low;
      for (std::int32_t place = begin; place < begin + 8; ++place)
        for (int axis = 0; axis < 3; ++axis) {
          const double x = points[static_cast<std::size_t>(*layer.at(place).id)][axis];
          low[axis] = std::min(low[axis], x);
          high[axis] = std::max(high[axis], x);
        }
      volume += (high.x - low.x) * (high.y - low.y) * (high.z - low.z);
    }
  }
  // Of eight cells' volume: 0.1 along the curve, 0.45 (7/9 cubed, about) in no order.
  EXPECT_LT(volume / blocks, 0.15 * 8);
}

/// A fluid of density 1 in a cube or in a drop, and what is asked for.
class GridUpdates : public ::testing::TestWithParam<int> {
 protected:
  static ListParams within(double cutoff) {
    ListParams params;
    params.cutoffs = TypeCutoffs(cutoff);
    return params;
  }
  static void expect_oracle(PairSearch& search, const std::vector<Vec3>& points, const Box& box,
                            const ListParams& params) {
    ASSERT_EQ(first_difference(search.list(params), all_pairs(points, box, params)), "");
  }
  std::unique_ptr<Executor> pool_ = GetParam() > 1 ? make_thread_pool(GetParam()) : nullptr;
};

// Points are put into cells for lists as the last ones; what is asked for may be another thing each time.
TEST_P(GridUpdates, ListsAreThoseOfTheRequestWhateverTheLastOneWas) {
  scenes::Random random(15);
  const auto search = make_grid_search(1.9, pool_.get());
  for (int step = 0; step < 12; ++step) {
    const double side = step % 5 == 4 ? 7 : 11;
    const Box box = step % 3 == 2 ? Box::none() : Box::orthorhombic({side, side, step % 4 == 3 ? 16 : side});
    const std::vector<Vec3> points =
        scenes::uniform_in(step % 3 == 2 ? Box::orthorhombic({side, side, side}) : box,
                           static_cast<std::size_t>(500 + 260 * (step % 4)), 16 + step);
    search->update(points, box);
    ListParams params = within(step % 2 == 0 ? 1.1 : 0.6 + 0.1 * step);
    ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, box, params)) << step;
    std::vector<double> radii;
    for (std::size_t i = 0; i < points.size(); ++i) radii.push_back(i % 50 == 0 ? 0.8 : 0.1);
    params.radii = radii;
    params.skin = 0.1;
    if (step % 4 == 1) {
      ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, box, params)) << step;
    }
    ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, box, within(1.7))) << step;
  }
}

// In the midst of good ones, at any place of a piece, after lists and before any.
TEST_P(GridUpdates, BadPositionsAreNamedAndNothingIsKept) {
  const Box box = Box::orthorhombic({11, 11, 11});
  const std::vector<Vec3> good = scenes::uniform_in(box, 1301, 17);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = HUGE_VAL;
  for (const bool has_listed : {false, true})
    for (const std::size_t bad : {0u, 1u, 511u, 512u, 777u, 1299u, 1300u})
      for (const double value : {nan, infinite, -infinite, 1e300, 1e18}) {
        const auto search = make_grid_search(1.2, pool_.get());
        if (has_listed) {
          search->update(good, box);
          search->list(within(1.2));
        }
        std::vector<Vec3> points = good;
        points[bad][static_cast<int>(bad % 3)] = value;
        EXPECT_THAT(test::message_of<InvalidPosition>([&] { search->update(points, box); }),
                    HasSubstr("position " + std::to_string(bad) + " "))
            << value;
        EXPECT_EQ(search->list(within(1.2)).size(), 0u);
        if (bad != 777) continue;
        search->update(good, box);
        ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, good, box, within(1.2)));
      }
}

// Far outside of the box, yet not so far that their places are lost: not in one pass, but the same lists.
TEST_P(GridUpdates, PositionsManyBoxesAwayAreListed) {
  const Box box = Box::orthorhombic({11, 11, 11});
  std::vector<Vec3> points = scenes::uniform_in(box, 1100, 18);
  const auto search = make_grid_search(1.2, pool_.get());
  for (const double away : {0.0, 11.0, 110.0, 11e6}) {
    for (std::size_t i = 0; i < points.size(); i += 97) points[i].y += away;
    search->update(points, box);
    ASSERT_NO_FATAL_FAILURE(expect_oracle(*search, points, box, within(1.2))) << away;
  }
}

// Cells of a thin gas are so wide that their integers do not tell a shell; a list with one has others.
TEST_P(GridUpdates, ShellsAreToldAfterListsThatHaveNone) {
  constexpr double kRadius = 2, kShell = 0.4, kInside = kRadius - kShell;
  constexpr double kOff = 0.002 * kRadius * kRadius;  // of the square, as ListParams::shell says
  const Box box = Box::orthorhombic({60, 60, 60});
  std::vector<Vec3> points = scenes::uniform_in(box, 6000, 19);
  scenes::Random random(20);
  for (int k = 0; k < 6000; ++k) {  // pairs just beyond what may be told wrong, on both sides
    const Vec3 v = random.in_ball(1);
    const double apart = std::sqrt(kInside * kInside + (k % 2 == 0 ? 1.02 : -1.02) * kOff);
    points.push_back(points[static_cast<std::size_t>(k)] + apart / std::sqrt(norm2(v)) * v);
  }
  const auto search = make_grid_search(kRadius, pool_.get());
  ListParams plain = within(kRadius), with_shell = plain;
  plain.order = with_shell.order = RowOrder::unsorted;
  with_shell.shell = kShell;
  for (int update = 0; update < 2; ++update) {
    search->update(points, box);
    search->list(plain);
    const NeighborList list = search->list(with_shell);
    ASSERT_EQ(list.near_end.size(), list.size());
    int wrong = 0;
    for (std::size_t row = 0; row < list.size(); ++row)
      for (std::int64_t k = list.first[row]; k < list.first[row + 1]; ++k) {
        const double beyond = box.distance2(points[static_cast<std::size_t>(list.particle[row])],
                                            points[static_cast<std::size_t>(list.j[k])]) -
                              kInside * kInside;
        wrong += k < list.near_end[row] ? beyond > kOff : beyond < -kOff;
      }
    EXPECT_EQ(wrong, 0) << update;
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, GridUpdates, ::testing::Values(1, 3));

}  // namespace
}  // namespace dch
