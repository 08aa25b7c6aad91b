// SPDX-License-Identifier: MIT
//
// Boxes of blocks by leaf, as they come and go, against a map of them.
#include "hierarchy/block_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "random.hpp"

namespace dch::detail {
namespace {

double gap_between(Vec3 at, const MeasuredLeaves::Corners& box) {
  Vec3 gap;
  for (int axis = 0; axis < 3; ++axis)
    gap[axis] = std::max({double{box.low[axis]} - at[axis], at[axis] - double{box.high[axis]}, 0.0});
  return std::sqrt(norm2(gap));
}

/// Leaves of extent `kExtent * scale` with blocks that come, grow and go, and what there should be of them.
class BlockBoxesTest : public testing::TestWithParam<double> {
 protected:
  static constexpr int kLeaves = 5;
  static constexpr double kExtent = 3;

  BlockBoxesTest() {
    for (std::int32_t leaf = 0; leaf < kLeaves; ++leaf) boxes_.add_leaf(leaf);
  }
  double scale() const { return GetParam(); }
  /// Into float; else all blocks may be called for.
  bool squares_fit() const { return scale() > 1e-13 && scale() < 1e13; }
  Vec3 somewhere(double by) { return random_.in_cube(by * scale()); }

  std::int32_t below(std::size_t count) { return static_cast<std::int32_t>(random_.below(count)); }
  void add() {
    const Vec3 at = somewhere(kExtent);
    const auto x = static_cast<float>(at.x), y = static_cast<float>(at.y), z = static_cast<float>(at.z);
    const MeasuredLeaves::Corners box{{x, y, z}, {x, y, z}};
    const std::int32_t leaf = below(kLeaves);
    boxes_.add(leaf, next_, box);
    expected_[next_++] = {leaf, box};
  }
  void widen() {
    auto& [block, entry] = *any();
    const Vec3 at = somewhere(kExtent);
    const float point[3] = {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
    boxes_.widen(block, point);
    for (int axis = 0; axis < 3; ++axis) {
      entry.second.low[axis] = std::min(entry.second.low[axis], point[axis]);
      entry.second.high[axis] = std::max(entry.second.high[axis], point[axis]);
    }
  }
  void remove() {
    const auto gone = any();
    boxes_.remove(gone->second.first, gone->first);
    expected_.erase(gone);
  }
  void remove_all(std::int32_t leaf) {
    boxes_.remove_all(leaf);
    for (auto entry = expected_.begin(); entry != expected_.end();)
      entry = entry->second.first == leaf ? expected_.erase(entry) : std::next(entry);
  }
  void change() {
    const std::int32_t what = below(100);
    if (what < 50 || expected_.empty()) return add();
    if (what < 60) return widen();
    if (what < 99) return remove();
    remove_all(below(kLeaves));
  }

  std::set<std::int32_t> called_for(std::int32_t leaf, Vec3 at, float most2) const {
    std::set<std::int32_t> called;
    boxes_.for_each_within(leaf, at, most2, [&](std::int32_t block, float) {
      EXPECT_TRUE(called.insert(block).second) << block << " twice";
    });
    return called;
  }
  /// All blocks within a distance are called for, none of another leaf, and none that is farther by more than
  /// rounding.
  void expect_those_within(std::int32_t leaf, Vec3 at, double within) {
    const double extent = kExtent * scale() * std::sqrt(3.0);
    const std::set<std::int32_t> called = called_for(leaf, at, BlockBoxes::most_gap2(at, extent, within));
    const double rounding = 1e-5 * (within + extent + std::sqrt(norm2(at)));
    for (const auto& [block, entry] : expected_) {
      if (entry.first != leaf) {
        EXPECT_EQ(called.count(block), 0u) << block;
        continue;
      }
      const double gap = gap_between(at, entry.second);
      const bool is_near = gap <= within, is_far = squares_fit() && gap > within + rounding;
      if (!is_near && !is_far) continue;
      EXPECT_EQ(called.count(block), is_near ? 1u : 0u) << block << " is " << gap << " away";
    }
  }

  BlockBoxes boxes_;
  std::map<std::int32_t, std::pair<std::int32_t, MeasuredLeaves::Corners>> expected_;
  scenes::Random random_{3};

 private:
  std::map<std::int32_t, std::pair<std::int32_t, MeasuredLeaves::Corners>>::iterator any() {
    return std::next(expected_.begin(), below(expected_.size()));
  }
  std::int32_t next_ = 0;
};

TEST_P(BlockBoxesTest, HasWhatCameAndDidNotGo) {
  for (int round = 0; round < 3000; ++round) {
    change();
    const auto leaf = static_cast<std::int32_t>(round % kLeaves);
    expect_those_within(leaf, somewhere(2 * kExtent), random_.uniform(0, 2 * kExtent * scale()));
    for (const auto& [block, entry] : expected_)
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(boxes_.corners(block).low[axis], entry.second.low[axis]) << block;
        ASSERT_EQ(boxes_.corners(block).high[axis], entry.second.high[axis]) << block;
      }
    if (HasFailure()) return;
  }
}

// The distance is that of the box to the last bit, where float hides many of them: far from it, and so near
// that the coordinates are millions of times as large as the gap.
TEST_P(BlockBoxesTest, HasABoxThatTouches) {
  while (expected_.size() < 40) add();
  for (int round = 0; round < 2000; ++round)
    for (const auto& [block, entry] : expected_) {
      const MeasuredLeaves::Corners& box = entry.second;
      const double by = kExtent * std::pow(10, random_.uniform(-8, 3));
      const Vec3 at = Vec3{box.low[0], box.low[1], box.low[2]} + somewhere(by);
      const double gap = gap_between(at, box), extent = kExtent * scale() * std::sqrt(3.0);
      const float most2 = BlockBoxes::most_gap2(at, extent, gap);
      ASSERT_EQ(called_for(entry.first, at, most2).count(block), 1u) << gap;
    }
}

TEST_P(BlockBoxesTest, HasAllWithinInfinity) {
  while (expected_.size() < 100) add();
  std::size_t called = 0;
  for (std::int32_t leaf = 0; leaf < kLeaves; ++leaf)
    called += called_for(leaf, {}, std::numeric_limits<float>::infinity()).size();
  EXPECT_EQ(called, expected_.size());
}

INSTANTIATE_TEST_SUITE_P(Scales, BlockBoxesTest, testing::Values(1e-30, 1e-12, 1, 1e12, 1e30),
                         [](const auto& scale) { return "Scale" + std::to_string(scale.index); });

}  // namespace
}  // namespace dch::detail
