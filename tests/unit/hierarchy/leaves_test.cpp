// SPDX-License-Identifier: MIT
//
// What lists are made from: each number of it beside its definition, in small scenes that hold every case.
//
// More than 300 lines: the three values of leaves, one after the other, of the same scenes.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "geometry/metric.hpp"
#include "leaves/leaf_source.hpp"
#include "lists/pair_filter.hpp"
#include "scenes.hpp"

namespace dch::detail {
namespace {

/// Leaves of given sizes, their points at random around the centers, in chains of blocks.
struct Scene {
  Scene(const Box& scene_box, const std::vector<std::int32_t>& sizes, std::uint64_t seed) : box(scene_box) {
    scenes::Random random(seed);
    for (const std::int32_t size : sizes) {
      Vec3 center = random.in_cube(9);
      center = box.wrap({std::round(center.x), std::round(center.y), std::round(center.z)});
      const std::int32_t k = centers.add(0, center);
      if (size == 0) centers.retire(k);
      for (std::int32_t n = 0; n < size; ++n) {
        if (n % kBlock == 0) {
          std::int32_t added = blocks.add_block(k);
          blocks.append(added, centers.first_child[k]);
          centers.first_child[k] = added;
        }
        const auto id = static_cast<std::int32_t>(positions.size());
        positions.push_back(center + (n == 1 ? Vec3{0, 3, -4} : random.in_ball(7)));
        blocks.push(centers.first_child[k], id, box.wrap(positions.back()));
      }
    }
  }
  void move(std::uint64_t seed) {
    scenes::Random random(seed);
    for (Vec3& p : positions) p = p + random.in_cube(1);
    if (box.periodic(0)) positions[2] = positions[2] + 5.0 * box.vector(0);  // more than a cell away
  }
  template <class F>
  void for_each_block(const F& f) const {  // f(leaf, number in the leaf, block)
    for (std::int32_t k = 0; k < centers.size(); ++k)
      for (std::int32_t n = 0, block = centers.first_child[k]; block != kNone; block = blocks.next[block])
        f(k, n++, block);
  }
  std::int32_t id(std::int32_t block, std::int32_t lane) const { return blocks.id[block * kBlock + lane]; }

  Box box;
  Level centers;
  LeafBlocks blocks;
  std::vector<Vec3> positions;
};

constexpr double kCovered2 = 25;  // a point of each leaf is exactly there at first

void expect_measured(const MeasuredLeaves& points, const Scene& scene) {
  const std::size_t leaves = scene.centers.position.size();
  std::vector<MeasuredLeaves::Leaf> expected(leaves);
  std::vector<Vec3> low(leaves), high(leaves);
  std::int32_t blocks = 0;
  scene.for_each_block([&](std::int32_t k, std::int32_t n, std::int32_t block) {
    MeasuredLeaves::Leaf& leaf = expected[static_cast<std::size_t>(k)];
    const std::int32_t b = points.leaves[k].first_block + n, count = scene.blocks.count[block];
    ASSERT_EQ(b, blocks++) << "blocks of leaves side by side";
    ASSERT_EQ(points.source[b], block);
    ASSERT_EQ(points.count[b], count);
    ASSERT_EQ(points.lanes[b], (1 << count) - 1);
    ++leaf.blocks;
    Vec3 least{1e9, 1e9, 1e9}, most{-1e9, -1e9, -1e9};
    for (std::int32_t lane = 0; lane < count; ++lane) {
      const Vec3 at = scene.box.wrap(scene.positions[scene.id(block, lane)]);
      ASSERT_EQ(scene.blocks.position[block * kBlock + lane], at);
      const Vec3 offset = scene.box.nearest_image(at - scene.centers.position[k]);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_NEAR(points.offsets[b].axis[axis][lane], offset[axis], 1e-6);
        least[axis] = std::min(least[axis], offset[axis]);
        most[axis] = std::max(most[axis], offset[axis]);
      }
      leaf.extent = std::max(leaf.extent, std::sqrt(norm2(offset)));
      leaf.uncovered += norm2(offset) > kCovered2;
    }
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_NEAR(points.corners[b].low[axis], least[axis], 1e-6);
      ASSERT_NEAR(points.corners[b].high[axis], most[axis], 1e-6);
      low[k][axis] = std::min(low[k][axis], least[axis]);
      high[k][axis] = std::max(high[k][axis], most[axis]);
      leaf.block_width = std::max(leaf.block_width, most[axis] - least[axis]);
      leaf.width = std::max(leaf.width, high[k][axis] - low[k][axis]);
      leaf.middle[axis] = 0.5 * (low[k][axis] + high[k][axis]);
    }
  });
  EXPECT_EQ(points.blocks, blocks);
  double extent = 0, width = 0, block_width = 0;
  for (std::size_t k = 0; k < leaves; ++k) {
    EXPECT_EQ(points.leaves[k].blocks, expected[k].blocks);
    EXPECT_NEAR(points.leaves[k].extent, expected[k].extent, 1e-12);
    EXPECT_NEAR(points.leaves[k].width, expected[k].width, 1e-12);
    EXPECT_NEAR(norm2(points.leaves[k].middle - expected[k].middle), 0, 1e-24);
    EXPECT_NEAR(points.leaves[k].block_width, expected[k].block_width, 1e-12);
    EXPECT_EQ(points.leaves[k].uncovered, expected[k].uncovered);
    extent = std::max(extent, expected[k].extent);
    width = std::max(width, expected[k].width);
    block_width = std::max(block_width, expected[k].block_width);
  }
  EXPECT_NEAR(points.largest_extent, extent, 1e-12);
  EXPECT_NEAR(points.largest_width, width, 1e-12);
  EXPECT_NEAR(points.largest_block_width, block_width, 1e-12);
}

const std::vector<Box>& boxes() {
  static const std::vector<Box> all{Box::none(), Box::orthorhombic({32, 64, 32}, {true, true, false}),
                                    Box::triclinic({32, 0, 0}, {8, 32, 0}, {-8, 4, 32})};
  return all;
}

TEST(MeasuredLeaves, MeasuresThemAndTakesNewPositions) {
  for (const Box& box : boxes()) {
    MeasuredLeaves points;
    for (const std::uint64_t seed : {1, 2, 3}) {  // more leaves, then fewer, in the same object
      Scene scene(box,
                  seed == 2 ? std::vector<std::int32_t>{3, 8, 0, 19, 2, 30, 9, 16}
                            : std::vector<std::int32_t>{5, 0, 21},
                  seed);
      points.forget_layout();
      with_metric(box, [&](const auto& metric) {
        points.measure(metric, scene.centers, scene.blocks, kCovered2, nullptr);
        ASSERT_NO_FATAL_FAILURE(expect_measured(points, scene)) << box.description();
        for (const std::uint64_t step : {4, 5}) {
          scene.move(step);
          points.refresh(metric, scene.centers, scene.positions, scene.blocks, kCovered2, nullptr);
          ASSERT_NO_FATAL_FAILURE(expect_measured(points, scene)) << box.description();
        }
      });
    }
  }
}

/// Leaves that have been measured, and lists that say what to label them with.
class LabelledLeavesTest : public ::testing::Test {
 protected:
  LabelledLeavesTest() {
    for (std::size_t i = 0; i < 100; ++i) {
      radii_.push_back(0.1 + 0.05 * static_cast<double>(i));
      types_.push_back(static_cast<std::int32_t>(i % 20));
    }
    for (std::size_t i = scene_.positions.size(); i-- > 0;) reversed_.push_back(static_cast<std::int32_t>(i));
    measure(scene_);
    by_radii_.radii = radii_;
    by_types_.types = types_;
    by_types_.cutoffs = TypeCutoffs(20, std::vector<double>(400, 1.0));
  }
  void measure(Scene& scene) {
    measured_.forget_layout();
    measured_.measure(OpenMetric(scene.box), scene.centers, scene.blocks, kCovered2, nullptr);
  }
  void label(const Scene& scene, const ListParams& params, std::uint64_t version,
             Span<const std::int32_t> particles = {}) {
    const PairFilter filter(scene.positions, scene.box, params, 0);
    labelled_.label(measured_, scene.blocks, {particles, version},
                    {filter.by(), params.radii, params.types, params.first_ghost}, nullptr);
  }
  /// Whether label() does anything.
  bool labels_anew(const ListParams& params, std::uint64_t version) {
    const std::int32_t before = std::exchange(labelled_.particle[0][0], -7);
    label(scene_, params, version);
    return std::exchange(labelled_.particle[0][0], before) != -7;
  }
  void expect_labelled(const ListParams& params, bool reversed = false) const {
    const bool by_types = params.cutoffs.types() > 1;
    ASSERT_EQ(labelled_.radii.empty(), params.radii.empty());
    ASSERT_EQ(labelled_.types.empty(), !by_types);
    std::vector<bool> owned(measured_.leaves.size());
    scene_.for_each_block([&](std::int32_t k, std::int32_t n, std::int32_t block) {
      const std::int32_t b = measured_.leaves[k].first_block + n;
      bool block_owned = false;
      for (std::int32_t lane = 0; lane < kBlock; ++lane) {
        const bool is_point = lane < measured_.count[b];
        const std::int32_t id = scene_.id(block, lane), particle = reversed && is_point ? reversed_[id] : id;
        ASSERT_EQ(labelled_.particle[b][lane], particle);
        if (!labelled_.radii.empty()) {
          ASSERT_EQ(labelled_.radii[b][lane], is_point ? static_cast<float>(radii_[particle]) : 0.0f);
        } else if (by_types) {
          ASSERT_EQ(labelled_.types[b][lane], is_point ? types_[particle] % kKernelTypes : 0);
        }
        block_owned |= is_point && (params.first_ghost < 0 || particle < params.first_ghost);
      }
      EXPECT_EQ(labelled_.owned[b] != 0, block_owned);
      if (block_owned) owned[static_cast<std::size_t>(k)] = true;
    });
    for (std::size_t k = 0; k < owned.size(); ++k)
      EXPECT_TRUE((labelled_.leaf_owned[k] != 0) == owned[k]) << k;
  }

  Scene scene_{Box::none(), {3, 8, 0, 19, 2, 30}, 1};
  Structure structure_;
  LeafSource source_{&structure_, {}, {}, {}};
  MeasuredLeaves& measured_ = structure_.leaves;
  LabelledLeaves& labelled_ = source_.labelled;
  QuantizedLeaves& quantized_ = source_.quantized;
  std::vector<double> radii_;
  std::vector<std::int32_t> types_, reversed_;
  ListParams one_, by_radii_, by_types_;
};

TEST_F(LabelledLeavesTest, ByWhatTheirCutoffsDependOn) {
  for (ListParams params : {one_, by_radii_, by_types_, one_})
    for (const std::int32_t first_ghost : {-1, 0, 4, 17, 40})
      for (const bool reversed : {false, true}) {
        params.first_ghost = first_ghost;
        measure(scene_);
        label(scene_, params, 0, reversed ? Span<const std::int32_t>(reversed_) : Span<const std::int32_t>());
        ASSERT_NO_FATAL_FAILURE(expect_labelled(params, reversed)) << first_ghost;
      }
}

TEST_F(LabelledLeavesTest, NothingIsLeftOfFullerBlocks) {
  Scene full(Box::none(), std::vector<std::int32_t>(12, kBlock), 2);
  for (const ListParams& params : {by_radii_, by_types_}) {
    measure(full);
    label(full, params, 0);
    measure(scene_);
    label(scene_, params, 0);
    ASSERT_NO_FATAL_FAILURE(expect_labelled(params));
  }
}

TEST_F(LabelledLeavesTest, AnewIfAnythingHasChanged) {
  label(scene_, one_, 0);
  EXPECT_FALSE(labels_anew(one_, 0));
  ListParams ghosts = one_;
  ghosts.first_ghost = 9;
  EXPECT_TRUE(labels_anew(ghosts, 0));
  EXPECT_FALSE(labels_anew(ghosts, 0));
  EXPECT_TRUE(labels_anew(one_, 3)) << "other names";
  measure(scene_);
  EXPECT_TRUE(labels_anew(one_, 3)) << "other places";
  EXPECT_TRUE(labels_anew(by_radii_, 3));
  EXPECT_FALSE(labels_anew(by_radii_, 3));
  EXPECT_TRUE(labels_anew(by_radii_, 4));
  EXPECT_TRUE(labels_anew(by_radii_, 0)) << "nobody knows what the sizes are";
  EXPECT_TRUE(labels_anew(by_radii_, 0));
  EXPECT_TRUE(labels_anew(by_types_, 4));
  EXPECT_FALSE(labels_anew(by_types_, 4));
  EXPECT_TRUE(labels_anew(by_types_, 0));
  EXPECT_TRUE(labels_anew(by_types_, 0));
}

/// A box of blocks as `center` and `half_width` [units] beside the lengths that it has to hold.
void expect_box(double center, double half_width, double low, double high, double unit) {
  EXPECT_NEAR(center, 0.5 * (low + high) / unit, 0.51);
  EXPECT_NEAR(half_width, 0.5 * (high - low) / unit + 2, 0.51);
}

TEST_F(LabelledLeavesTest, RoundedToUnits) {
  for (const ListParams& params : {by_radii_, by_types_, one_}) {
    label(scene_, params, 0);
    const ListUnits units{0.00231, 0.0173};
    quantized_.quantize(measured_, labelled_, units, scene_.centers.position, nullptr);
    EXPECT_EQ(quantized_.units.point, units.point);
    EXPECT_DOUBLE_EQ(quantized_.per_unit.point * units.point, 1);
    EXPECT_DOUBLE_EQ(quantized_.per_unit.box * units.box, 1);
    const BlockSpans boxes = quantized_.boxes();
    for (std::int32_t b = 0; b < measured_.blocks + kChunk; ++b) ASSERT_EQ(boxes.number[b], b);
    scene_.for_each_block([&](std::int32_t k, std::int32_t n, std::int32_t) {
      const std::int32_t b = measured_.leaves[k].first_block + n;
      const std::int16_t* const at[] = {quantized_.points[b].x, quantized_.points[b].y,
                                        quantized_.points[b].z};
      for (int axis = 0; axis < 3; ++axis) {
        const double origin = quantized_.origin[k][axis];
        const double of_space = (scene_.centers.position[k][axis] + origin) / units.point;
        ASSERT_NEAR(of_space, std::round(of_space), 1e-6);
        ASSERT_LE(std::abs(origin - measured_.leaves[k].middle[axis]), 0.51 * units.point);
        const float low = measured_.corners[b].low[axis], high = measured_.corners[b].high[axis];
        const BlockSpan& span = quantized_.spans[b];
        expect_box(span.center[axis], span.half_width[axis], low - origin, high - origin, units.point);
        expect_box(boxes.center[axis][b], boxes.half_width[axis][b], low, high, units.box);
        for (int lane = 0; lane < measured_.count[b]; ++lane) {
          ASSERT_NEAR(at[axis][lane], (measured_.offsets[b].axis[axis][lane] - origin) / units.point, 0.51);
          ASSERT_LE(std::abs(at[axis][lane] - span.center[axis]), span.half_width[axis]);
        }
      }
      for (int lane = 0; lane < measured_.count[b] && !params.radii.empty(); ++lane)
        ASSERT_NEAR(quantized_.radii[b][lane], labelled_.radii[b][lane] / units.point, 0.51);
    });
  }
}

// Far out the sum of a center and a middle is rounded by more than a unit.
TEST_F(LabelledLeavesTest, OriginsAreInTheMiddleFarOut) {
  label(scene_, one_, 0);
  for (const double far : {1e3, 1e9, 0x1p45, 0x1p51, 1e18}) {
    const std::vector<Vec3> centers(measured_.leaves.size(), Vec3{far, -far, 1.5 * far});
    const ListUnits units{0.00231, 0.0173};
    quantized_.quantize(measured_, labelled_, units, centers, nullptr);
    for (std::size_t k = 0; k < centers.size(); ++k)
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_LE(std::abs(quantized_.origin[k][axis] - measured_.leaves[k].middle[axis]), 0.6 * units.point)
            << far;
  }
}

/// That a box holds others along an axis, with no more room than halves of integers need.
template <class BoxOf>
void expect_around(const BlockSpan& around, std::int32_t first, std::int32_t last, const BoxOf& box_of) {
  for (int axis = 0; axis < 3; ++axis) {
    int least = 40000, most = -40000;
    for (std::int32_t b = first; b < last; ++b) {
      const auto [center, half_width] = box_of(b, axis);
      least = std::min(least, center - half_width);
      most = std::max(most, center + half_width);
    }
    const int low = around.center[axis] - around.half_width[axis];
    const int high = around.center[axis] + around.half_width[axis];
    ASSERT_LE(low, least);
    ASSERT_GE(high, most);
    ASSERT_LE(high - low, most - least + 1);
  }
}

TEST_F(LabelledLeavesTest, BoxesAndTagsOfSeveralBlocks) {
  label(scene_, by_radii_, 0);
  quantized_.quantize(measured_, labelled_, {0.00231, 0.0173}, scene_.centers.position, nullptr);
  const BlockSpans boxes = quantized_.boxes();
  for (std::int32_t first = 0; first < measured_.blocks; ++first)
    for (std::int32_t last = first + 1; last <= measured_.blocks; ++last) {
      expect_around(source_.blocks(first, last).span_of(0, last - first), first, last,
                    [&](std::int32_t b, int axis) {
                      return std::pair<int, int>(quantized_.spans[b].center[axis],
                                                 quantized_.spans[b].half_width[axis]);
                    });
      expect_around(quantized_.box_of(first, last), first, last, [&](std::int32_t b, int axis) {
        return std::pair<int, int>(boxes.center[axis][b], boxes.half_width[axis][b]);
      });
      std::int16_t largest = 0;
      for (std::int32_t b = first; b < last; ++b)
        for (const std::int16_t tag : quantized_.radii[b]) largest = std::max(largest, tag);
      EXPECT_EQ(source_.blocks(first, last).largest_tag(0, last - first), largest);
    }
}

}  // namespace
}  // namespace dch::detail
