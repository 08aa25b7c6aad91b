// SPDX-License-Identifier: MIT
#include "hierarchy/measured_leaves.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <type_traits>

#include "base/resize.hpp"
#include "geometry/metric.hpp"

namespace dch::detail {
namespace {

constexpr std::int32_t kAhead = 8;  ///< blocks that positions are asked for before they are measured

Vec3 lower(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 upper(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
double longest(Vec3 sides) { return std::max(sides.x, std::max(sides.y, sides.z)); }

/// Takes positions, by id or, if there are none, those in the slots, and puts them into the slots wrapped
/// where these keep any.
template <class Metric>
class BlockMeter {
 public:
  BlockMeter(const Metric& metric, const Vec3* positions, LeafBlocks& blocks, double covered2)
      : metric_(metric), positions_(positions), blocks_(blocks), covered2_(covered2) {
    if constexpr (kIsBrick) cell_ = metric.brick();
  }

  /// Has the positions of a block fetched that is to be measured soon: they lie anywhere.
  void ask_for(std::int32_t block) const {
    if (positions_ != nullptr) blocks_.ask_for(block, positions_);
  }

  /// @param offsets null if they are not wanted
  void measure(std::int32_t block, Vec3 center, MeasuredLeaves::Offsets* offsets, BlockExtremes& out) const {
    const std::int32_t first = block * kBlock, count = blocks_.count[block];
    if constexpr (kIsBrick) {
      std::int32_t slots[kBlock];
      for (std::int32_t lane = 0; lane < kBlock; ++lane) slots[lane] = first + lane;
      const double from[3] = {center.x, center.y, center.z};
      const bool done = kernel_(cell_, &(positions_ ? positions_ : blocks_.position.data())->x,
                                positions_ ? blocks_.id.data() + first : slots, count, from, covered2_,
                                blocks_.keeps_positions ? &blocks_.position[first].x : nullptr,
                                offsets != nullptr ? offsets->axis[0] : nullptr, out);
      if (done) return;
    }
    for (int axis = 0; axis < 3; ++axis) {
      out.low[axis] = std::numeric_limits<double>::infinity();
      out.high[axis] = -out.low[axis];
    }
    out.extent2 = 0;
    out.uncovered = 0;
    out.is_plain = false;
    for (std::int32_t slot = first; slot < first + count; ++slot) {
      const Vec3 wrapped = positions_ ? metric_.wrap(positions_[blocks_.id[slot]]) : blocks_.position[slot];
      if (blocks_.keeps_positions) blocks_.position[slot] = wrapped;
      const Vec3 at = metric_.displacement(center, wrapped);
      for (int axis = 0; axis < 3; ++axis) {
        if (offsets != nullptr) offsets->axis[axis][slot - first] = static_cast<float>(at[axis]);
        out.low[axis] = std::min(out.low[axis], at[axis]);
        out.high[axis] = std::max(out.high[axis], at[axis]);
      }
      out.extent2 = std::max(out.extent2, norm2(at));
      out.uncovered += norm2(at) > covered2_;
    }
  }

 private:
  static constexpr bool kIsBrick = !std::is_same_v<Metric, LatticeMetric>;
  const Metric& metric_;
  const Vec3* positions_;
  LeafBlocks& blocks_;
  double covered2_;
  BrickCell cell_;
  MeasureBlock kernel_ = measure_block(instruction_set());
};

}  // namespace

template <class Metric>
void MeasuredLeaves::measure(const Metric& metric, const Level& centers, LeafBlocks& from, double covered2,
                             Executor* executor) {
  measure_all(metric, centers, nullptr, from, covered2, executor);
}

template <class Metric>
void MeasuredLeaves::refresh(const Metric& metric, const Level& centers, Span<const Vec3> positions,
                             LeafBlocks& into, double covered2, Executor* executor) {
  measure_all(metric, centers, positions.data(), into, covered2, executor);
}

/// Says where the blocks of each leaf lie.
void MeasuredLeaves::lay_out(const Level& centers, const LeafBlocks& from) {
  if (layout != 0) return;
  leaves.assign(centers.position.size(), Leaf());
  const std::size_t most = from.leaf.size();
  resize_closely(source, most);
  resize_closely(count, most);
  resize_closely(lanes, most);
  resize_closely(are_plain, most);
  resize_closely(corners, most);
  resize_closely(offsets, from.keeps_positions ? most : 0);
  blocks = 0;
  for (std::int32_t k = 0; k < centers.size(); ++k) {
    leaves[k].first_block = blocks;
    if (!centers.is_alive(k)) continue;
    for (std::int32_t block = centers.first_child[k]; block != kNone; block = from.next[block])
      source[blocks++] = block;
    leaves[k].blocks = blocks - leaves[k].first_block;
  }
  are_in_order = !from.keeps_positions;
  for (std::int32_t b = 0; b < blocks; ++b) {
    are_in_order = are_in_order && source[b] == b;
    count[b] = static_cast<std::uint8_t>(from.count[source[b]]);
    lanes[b] = static_cast<std::uint8_t>((1u << count[b]) - 1);
  }
  static std::atomic<std::uint64_t> last{0};  // says that two differ, and nothing else
  layout = ++last;
}

template <class Metric>
void MeasuredLeaves::measure_all(const Metric& metric, const Level& centers, const Vec3* positions,
                                 LeafBlocks& from, double covered2, Executor* executor) {
  lay_out(centers, from);
  const BlockMeter<Metric> meter(metric, positions, from, covered2);
  for_ranges(executor, centers.size(), [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t k = first; k < last; ++k)
      if (centers.is_alive(k)) measure_leaf(meter, centers.position[k], leaves[k]);
  });
  largest_extent = largest_width = largest_block_width = 0;
  for (const Leaf& leaf : leaves) {
    largest_extent = std::max(largest_extent, leaf.extent);
    largest_width = std::max(largest_width, leaf.width);
    largest_block_width = std::max(largest_block_width, leaf.block_width);
  }
}

template <class Meter>
void MeasuredLeaves::measure_leaf(const Meter& meter, Vec3 center, Leaf& leaf) {
  double extent2 = 0;
  leaf.block_width = 0;
  leaf.uncovered = 0;
  Vec3 leaf_low{}, leaf_high{};  // the center is in the box
  for (std::int32_t b = leaf.first_block; b < leaf.first_block + leaf.blocks; ++b) {
    if (b + kAhead < blocks) meter.ask_for(source[b + kAhead]);
    BlockExtremes measured;
    meter.measure(source[b], center, offsets.empty() ? nullptr : &offsets[b], measured);
    const Vec3 low{measured.low[0], measured.low[1], measured.low[2]};
    const Vec3 high{measured.high[0], measured.high[1], measured.high[2]};
    for (int axis = 0; axis < 3; ++axis) {
      corners[b].low[axis] = static_cast<float>(low[axis]);
      corners[b].high[axis] = static_cast<float>(high[axis]);
    }
    are_plain[b] = measured.is_plain ? 1 : 0;
    extent2 = std::max(extent2, measured.extent2);
    leaf.uncovered += measured.uncovered;
    leaf.block_width = std::max(leaf.block_width, longest(high - low));
    leaf_low = lower(leaf_low, low);
    leaf_high = upper(leaf_high, high);
  }
  leaf.extent = std::sqrt(extent2);
  leaf.width = longest(leaf_high - leaf_low);
  leaf.middle = 0.5 * (leaf_low + leaf_high);
}

std::size_t MeasuredLeaves::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  return bytes_of(leaves) + bytes_of(source) + bytes_of(count) + bytes_of(lanes) + bytes_of(are_plain) +
         bytes_of(offsets) + bytes_of(corners);
}

#define DCH_INSTANTIATE(Metric)                                                                             \
  template void MeasuredLeaves::measure(const Metric&, const Level&, LeafBlocks&, double, Executor*);       \
  template void MeasuredLeaves::refresh(const Metric&, const Level&, Span<const Vec3>, LeafBlocks&, double, \
                                        Executor*);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
