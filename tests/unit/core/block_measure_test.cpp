// SPDX-License-Identifier: MIT
#include "simd/block_measure.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include <dch/geometry/box.hpp>

#include "geometry/metric.hpp"
#include "instruction_sets.hpp"
#include "leaves/rounding.hpp"
#include "random.hpp"

namespace dch::detail {
namespace {

struct Measured {
  bool done = false;
  Vec3 wrapped[kBlock];
  float offset[3 * kBlock] = {};
  BlockExtremes extremes{};
};

Measured measure(InstructionSet set, const OrthorhombicMetric& metric, const std::vector<Vec3>& positions,
                 std::vector<std::int32_t> index, Vec3 center, double covered2) {
  Measured m;
  const auto count = static_cast<std::int32_t>(index.size());
  index.resize(kBlock, -1);
  const double from[3] = {center.x, center.y, center.z};
  m.done = measure_block(set)(metric.brick(), &positions[0].x, index.data(), count, from, covered2,
                              &m.wrapped[0].x, m.offset, m.extremes);
  BlockExtremes alone{};
  EXPECT_EQ(measure_block(set)(metric.brick(), &positions[0].x, index.data(), count, from, covered2, nullptr,
                               nullptr, alone),
            m.done);
  float offset[3 * kBlock] = {};
  EXPECT_EQ(offset_block(set)(metric.brick(), &positions[0].x, index.data(), count, from, offset), m.done);
  const BlockUnits units{{0.3F, -0.2F, 7.1F}, 321.7F};
  std::int16_t numbers[3 * kBlock] = {};
  if (m.extremes.is_plain) round_block(set)(&positions[0].x, index.data(), from, units, numbers);
  for (int axis = 0; m.done && axis < 3; ++axis) {
    EXPECT_EQ(alone.low[axis], m.extremes.low[axis]);
    EXPECT_EQ(alone.high[axis], m.extremes.high[axis]);
    for (int lane = 0; lane < count; ++lane) {
      const float at = m.offset[axis * kBlock + lane];
      EXPECT_EQ(offset[axis * kBlock + lane], at);
      if (m.extremes.is_plain) {
        EXPECT_EQ(numbers[axis * kBlock + lane], rounded((at - units.origin[axis]) * units.per_unit));
      }
    }
  }
  return m;
}

// What the metric says point by point, bit by bit, on every instruction set and for every number of points.
TEST(BlockMeasureTest, EveryInstructionSetAgreesWithTheMetric) {
  const Box box = Box::orthorhombic({7, 8, 9}, {true, false, true}, {-3, 1, 2});
  const OrthorhombicMetric metric(box);
  scenes::Random random(4);
  int plain = 0;
  for (int repeat = 0; repeat < 400; ++repeat) {
    std::vector<Vec3> positions;
    for (int k = 0; k < 20; ++k)
      positions.push_back(Vec3{0.5, 5, 6.5} + random.in_cube(repeat % 2 == 0 ? 6.5 : 1));
    std::vector<std::int32_t> index(1 + random.below(kBlock));
    for (std::int32_t& k : index) k = static_cast<std::int32_t>(random.below(positions.size()));
    const Vec3 center = box.wrap(random.in_cube(9));
    const double covered2 = 9;
    for (const InstructionSet set : kInstructionSets) {
      if (!is_supported(set)) continue;
      const Measured m = measure(set, metric, positions, index, center, covered2);
      ASSERT_TRUE(m.done);
      double extent2 = 0;
      int uncovered = 0;
      bool is_plain = true;
      for (std::size_t lane = 0; lane < index.size(); ++lane) {
        const Vec3 wrapped = box.wrap(positions[index[lane]]), at = metric.displacement(center, wrapped);
        EXPECT_EQ(m.wrapped[lane], wrapped);
        extent2 = std::max(extent2, norm2(at));
        uncovered += norm2(at) > covered2;
        is_plain = is_plain && wrapped == positions[index[lane]] && at == wrapped - center;
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(m.offset[axis * kBlock + lane], static_cast<float>(at[axis]));
          EXPECT_LE(m.extremes.low[axis], at[axis]);
          EXPECT_GE(m.extremes.high[axis], at[axis]);
        }
      }
      EXPECT_EQ(m.extremes.extent2, extent2);
      EXPECT_EQ(m.extremes.uncovered, uncovered);
      EXPECT_EQ(m.extremes.is_plain, is_plain);
      plain += is_plain;
    }
  }
  EXPECT_GT(plain, 100);
}

TEST(BlockMeasureTest, PointsMoreThanACellAwayAreLeftToTheBox) {
  const Box box = Box::orthorhombic({7, 8, 9});
  const OrthorhombicMetric metric(box);
  for (const InstructionSet set : kInstructionSets) {
    if (!is_supported(set)) continue;
    EXPECT_TRUE(measure(set, metric, {{-6.9, 15.9, 0}, {1, 1, 1}}, {0, 1}, {1, 1, 1}, 1).done);
    EXPECT_FALSE(measure(set, metric, {{1, 1, 1}, {-7.1, 1, 1}}, {0, 1}, {1, 1, 1}, 1).done);
    EXPECT_FALSE(measure(set, metric, {{1, 16.1, 1}}, {0}, {1, 1, 1}, 1).done);
  }
}

}  // namespace
}  // namespace dch::detail
