// SPDX-License-Identifier: MIT
#include "near_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/metric.hpp"
#include "geometry/near_images.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

/// Of a coordinate: offsets and shifts are rounded to float, then their sum, then a difference of two sums,
/// along three axes; with room to spare.
constexpr double kRoundings = 16 * 0x1p-24;

constexpr float kNowhere = std::numeric_limits<float>::infinity();

/// Squared distance of the frame's origin from a box.
double gap2_of(const MeasuredLeaves::Corners& corners, Vec3 shift) {
  Vec3 gap;
  for (int axis = 0; axis < 3; ++axis)
    gap[axis] = std::max({corners.low[axis] + shift[axis], -corners.high[axis] - shift[axis], 0.0});
  return norm2(gap);
}

}  // namespace

void NearLeaves::clear() {
  count_ = 0;
  widest_ = 0;
}

/// For so many more blocks.
void NearLeaves::make_room(std::int32_t blocks) {
  const auto wanted = static_cast<std::size_t>(count_) + static_cast<std::size_t>(blocks) + kChunk;
  if (wanted <= source_.size()) return;
  const std::size_t room = wanted + wanted / 2;
  for (int axis = 0; axis < 3; ++axis) {
    low_[axis].resize(room);
    high_[axis].resize(room);
  }
  coordinates_.resize(3 * kBlock * room);
  source_.resize(room);
}

template <class Metric>
void NearLeaves::collect(const Metric& metric, std::int32_t leaf, double reach, NearestWork& work) {
  clear();
  const Vec3 center = structure_.levels[1].position[leaf];
  const double own_radius = balls_.radius(1, leaf), within = own_radius + reach;
  add_leaf(leaf, {}, within);
  own_ = count();
  for_each_near_image(structure_.box, {}, (within + own_radius) * kInflate, false, [&](Vec3 at) {
    if (at != Vec3{}) add_leaf(leaf, at, within);
  });
  stack_.clear();
  const auto look_at = [&](std::int32_t level, std::int32_t node) {
    ++work.nodes;
    if (level == 1 && node == leaf) return;
    const Vec3 at = metric.displacement(center, structure_.position(level, node));
    const double radius = balls_.radius(level, node);
    if (norm2(at) > (within + radius) * (within + radius) * kInflate) return;
    if (level > 1) return stack_.push_back({level, node});
    for_each_near_image(structure_.box, at, (within + radius) * kInflate, false,
                        [&](Vec3 image) { add_leaf(node, image, within); });
  };
  const Level& top = structure_.levels.back();
  for (std::int32_t root = 0; root < top.size(); ++root)
    if (top.is_alive(root)) look_at(structure_.top(), root);
  while (!stack_.empty()) {
    const Subtree next = stack_.back();
    stack_.pop_back();
    if (structure_.is_singleton(next.level, next.node)) {
      const std::int32_t id = structure_.levels[next.level].id[next.node];
      for_each_near_image(structure_.box, metric.displacement(center, metric.wrap(structure_.raw[id])),
                          within * kInflate, false, [&](Vec3 image) { add_point(id, image); });
    }
    structure_.for_each_child(next.level, next.node,
                              [&](std::int32_t child) { look_at(next.level - 1, child); });
  }
  rounding_ = kRoundings * widest_;
}

/// The blocks of a leaf whose boxes are within a distance of the frame's origin.
void NearLeaves::add_leaf(std::int32_t leaf, Vec3 shift, double within) {
  const MeasuredLeaves& measured = structure_.leaves;
  const MeasuredLeaves::Leaf& from = measured.leaves[leaf];
  const double size = from.extent + std::max({std::abs(shift.x), std::abs(shift.y), std::abs(shift.z)});
  const double limit = within + kRoundings * size;
  make_room(from.blocks);
  for (std::int32_t b = from.first_block; b < from.first_block + from.blocks; ++b) {
    if (gap2_of(measured.corners[b], shift) > limit * limit) continue;
    widest_ = std::max(widest_, size);
    add_block(b, shift);
  }
}

void NearLeaves::add_block(std::int32_t measured, Vec3 shift) {
  const MeasuredLeaves& leaves = structure_.leaves;
  const std::int32_t count = leaves.count[measured];
  for (int axis = 0; axis < 3; ++axis) {
    const auto by = static_cast<float>(shift[axis]);
    low_[axis][count_] = leaves.corners[measured].low[axis] + by;
    high_[axis][count_] = leaves.corners[measured].high[axis] + by;
    const float* const from = leaves.offsets[measured].axis[axis];
    float* const to = coordinates_.data() + (3 * static_cast<std::ptrdiff_t>(count_) + axis) * kBlock;
    for (std::int32_t lane = 0; lane < kBlock; ++lane) to[lane] = lane < count ? from[lane] + by : kNowhere;
  }
  source_[count_++] = leaves.source[measured];
}

/// A point that is in no leaf gets a block of its own.
void NearLeaves::add_point(std::int32_t id, Vec3 at) {
  make_room(1);
  widest_ = std::max({widest_, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
  for (int axis = 0; axis < 3; ++axis) {
    const auto coordinate = static_cast<float>(at[axis]);
    low_[axis][count_] = high_[axis][count_] = coordinate;
    float* const to = coordinates_.data() + (3 * static_cast<std::ptrdiff_t>(count_) + axis) * kBlock;
    std::fill_n(to, kBlock, kNowhere);
    to[0] = coordinate;
  }
  source_[count_++] = id_of(id);
}

NearBlocks NearLeaves::blocks() const {
  return {{low_[0].data(), low_[1].data(), low_[2].data()},
          {high_[0].data(), high_[1].data(), high_[2].data()},
          coordinates_.data()};
}

template void NearLeaves::collect(const OpenMetric&, std::int32_t, double, NearestWork&);
template void NearLeaves::collect(const OrthorhombicMetric&, std::int32_t, double, NearestWork&);
template void NearLeaves::collect(const LatticeMetric&, std::int32_t, double, NearestWork&);

}  // namespace dch::detail
