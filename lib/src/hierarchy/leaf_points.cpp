// SPDX-License-Identifier: MIT
#include "hierarchy/leaf_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

#include "geometry/metric.hpp"

namespace dch::detail {
namespace {

Vec3 lower(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 upper(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
double longest(Vec3 sides) { return std::max(sides.x, std::max(sides.y, sides.z)); }

/// Takes positions, by id or, if there are none, those in the slots, and puts them into the slots wrapped.
template <class Metric>
class BlockMeter {
 public:
  BlockMeter(const Metric& metric, const Vec3* positions, PointBlocks& blocks, double covered2)
      : metric_(metric), positions_(positions), blocks_(blocks), covered2_(covered2) {
    if constexpr (kIsBrick) cell_ = metric.brick();
  }

  void measure(std::int32_t block, Vec3 center, ClusterPoints::Offsets& offsets, BlockExtremes& out) const {
    const std::int32_t first = block * kBlock, count = blocks_.count[block];
    if constexpr (kIsBrick) {
      std::int32_t slots[kBlock];
      for (std::int32_t lane = 0; lane < kBlock; ++lane) slots[lane] = first + lane;
      const double from[3] = {center.x, center.y, center.z};
      const bool done = kernel_(cell_, &(positions_ ? positions_ : blocks_.position.data())->x,
                                positions_ ? blocks_.id.data() + first : slots, count, from, covered2_,
                                &blocks_.position[first].x, offsets.axis[0], out);
      if (done) return;
    }
    for (int axis = 0; axis < 3; ++axis) {
      out.low[axis] = std::numeric_limits<double>::infinity();
      out.high[axis] = -out.low[axis];
    }
    out.extent2 = 0;
    out.uncovered = 0;
    for (std::int32_t slot = first; slot < first + count; ++slot) {
      if (positions_) blocks_.position[slot] = metric_.wrap(positions_[blocks_.id[slot]]);
      const Vec3 at = metric_.displacement(center, blocks_.position[slot]);
      for (int axis = 0; axis < 3; ++axis) {
        offsets.axis[axis][slot - first] = static_cast<float>(at[axis]);
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
  PointBlocks& blocks_;
  double covered2_;
  BrickCell cell_;
  MeasureBlock kernel_ = measure_block(instruction_set());
};

/// Holds the rounded points between the corners, and the corners themselves.
BlockSpan span_around(const ClusterPoints::Corners& corners, float per_unit) {
  BlockSpan span{};
  for (int axis = 0; axis < 3; ++axis) {
    const float low = corners.low[axis] * per_unit, high = corners.high[axis] * per_unit;
    span.center[axis] = rounded(0.5f * (low + high));
    span.half_width[axis] = static_cast<std::int16_t>(rounded(0.5f * (high - low)) + 2);
  }
  return span;
}

/// Around those of blocks [first, last), whose center and half width along an axis span_of(block, axis)
/// gives.
template <class SpanOf>
BlockSpan around(std::int32_t first, std::int32_t last, const SpanOf& span_of) {
  BlockSpan span{};
  for (int axis = 0; axis < 3; ++axis) {
    int least = std::numeric_limits<int>::max(), most = std::numeric_limits<int>::lowest();
    for (std::int32_t b = first; b < last; ++b) {
      const auto [center, half_width] = span_of(b, axis);
      least = std::min(least, center - half_width);
      most = std::max(most, center + half_width);
    }
    span.center[axis] = static_cast<std::int16_t>((least + most) / 2);
    span.half_width[axis] = static_cast<std::int16_t>((most - least + 1) / 2);
  }
  return span;
}

}  // namespace

template <class Metric>
void ClusterPoints::measure(const Metric& metric, const Level& centers, PointBlocks& from, double covered2,
                            Executor* executor) {
  measure_all(metric, centers, nullptr, from, covered2, executor);
}

template <class Metric>
void ClusterPoints::refresh(const Metric& metric, const Level& centers, Span<const Vec3> positions,
                            PointBlocks& into, double covered2, Executor* executor) {
  measure_all(metric, centers, positions.data(), into, covered2, executor);
}

/// Says where the blocks of each cluster lie.
void ClusterPoints::lay_out(const Level& centers, const PointBlocks& from) {
  if (laid_out_) return;
  clusters.assign(centers.position.size(), Cluster());
  const std::size_t most = from.cluster.size();
  source.resize(most);
  count.resize(most);
  lanes.resize(most);
  corners.resize(most);
  offsets.resize(most);
  blocks = 0;
  for (std::int32_t k = 0; k < centers.size(); ++k) {
    clusters[k].first_block = blocks;
    if (!centers.is_alive(k)) continue;
    for (std::int32_t block = centers.first_child[k]; block != kNone; block = from.next[block])
      source[blocks++] = block;
    clusters[k].blocks = blocks - clusters[k].first_block;
  }
  for (std::int32_t b = 0; b < blocks; ++b) {
    count[b] = static_cast<std::uint8_t>(from.count[source[b]]);
    lanes[b] = static_cast<std::uint8_t>((1u << count[b]) - 1);
  }
  laid_out_ = true;
}

template <class Metric>
void ClusterPoints::measure_all(const Metric& metric, const Level& centers, const Vec3* positions,
                                PointBlocks& from, double covered2, Executor* executor) {
  lay_out(centers, from);
  const BlockMeter<Metric> meter(metric, positions, from, covered2);
  for_ranges(executor, centers.size(), [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t k = first; k < last; ++k)
      if (centers.is_alive(k)) measure_cluster(meter, centers.position[k], clusters[k]);
  });
  largest_extent = largest_width = largest_block_width = 0;
  for (const Cluster& cluster : clusters) {
    largest_extent = std::max(largest_extent, cluster.extent);
    largest_width = std::max(largest_width, cluster.width);
    largest_block_width = std::max(largest_block_width, cluster.block_width);
  }
}

template <class Meter>
void ClusterPoints::measure_cluster(const Meter& meter, Vec3 center, Cluster& cluster) {
  double extent2 = 0;
  cluster.block_width = 0;
  cluster.uncovered = 0;
  Vec3 cluster_low{}, cluster_high{};  // the center is in the box
  for (std::int32_t b = cluster.first_block; b < cluster.first_block + cluster.blocks; ++b) {
    BlockExtremes measured;
    meter.measure(source[b], center, offsets[b], measured);
    const Vec3 low{measured.low[0], measured.low[1], measured.low[2]};
    const Vec3 high{measured.high[0], measured.high[1], measured.high[2]};
    for (int axis = 0; axis < 3; ++axis) {
      corners[b].low[axis] = static_cast<float>(low[axis]);
      corners[b].high[axis] = static_cast<float>(high[axis]);
    }
    extent2 = std::max(extent2, measured.extent2);
    cluster.uncovered += measured.uncovered;
    cluster.block_width = std::max(cluster.block_width, longest(high - low));
    cluster_low = lower(cluster_low, low);
    cluster_high = upper(cluster_high, high);
  }
  cluster.extent = std::sqrt(extent2);
  cluster.width = longest(cluster_high - cluster_low);
}

void ClusterPoints::name(const PointBlocks& from, const ParticleNames& names, const PairFilter& filter,
                         Executor* executor) {
  const ListParams& params = filter.params();
  const Naming naming{names.version, filter.by(), params.first_ghost, params.radii.data(),
                      params.types.data()};
  const bool sizes_are_known = names.version != 0 || filter.by() == PairFilter::By::one_cutoff;
  if (named_ && sizes_are_known && naming == naming_) return;
  named_ = false;
  const auto all = static_cast<std::size_t>(blocks);
  ids.resize(all);
  owned.resize(all);
  radii.resize(filter.by() == PairFilter::By::radii ? all : 0);
  tags.resize(filter.by() == PairFilter::By::one_cutoff ? 0 : all);
  for_ranges(executor, static_cast<std::int32_t>(clusters.size()),
             [&](std::int32_t first, std::int32_t last) {
               for (std::int32_t k = first; k < last; ++k) {
                 Cluster& cluster = clusters[k];
                 cluster.owned = params.first_ghost < 0;
                 for (std::int32_t b = cluster.first_block; b < cluster.first_block + cluster.blocks; ++b) {
                   name_block(b, from, names.particle_of_id, filter);
                   cluster.owned |= owned[b] != 0;
                 }
               }
             });
  naming_ = naming;
  named_ = true;
}

void ClusterPoints::name_block(std::int32_t b, const PointBlocks& from,
                               Span<const std::int32_t> particle_of_id, const PairFilter& filter) {
  const ListParams& params = filter.params();
  std::copy_n(from.id.data() + static_cast<std::size_t>(source[b]) * kBlock, kBlock, ids[b].data());
  for (int lane = 0; lane < count[b] && !particle_of_id.empty(); ++lane)
    ids[b][lane] = particle_of_id[ids[b][lane]];
  owned[b] = params.first_ghost < 0;
  for (int lane = 0; lane < count[b] && !owned[b]; ++lane) owned[b] = ids[b][lane] < params.first_ghost;
  if (!radii.empty()) {
    radii[b].fill(0);
    for (int lane = 0; lane < count[b]; ++lane)
      radii[b][lane] = static_cast<float>(params.radii[ids[b][lane]]);
  } else if (!tags.empty()) {
    tags[b].fill(0);
    for (int lane = 0; lane < count[b]; ++lane)
      tags[b][lane] = static_cast<std::int16_t>(params.types[ids[b][lane]] % kKernelTypes);
  }
}

void ClusterPoints::quantize(const ListUnits& to_units, Executor* executor) {
  units = to_units;
  per_unit = {1 / units.point, 1 / units.box};
  const auto all = static_cast<std::size_t>(blocks);
  points.resize(all);
  spans.resize(all);
  for (int axis = 0; axis < 3; ++axis) {
    box_center_[axis].resize(all + kChunk);
    box_half_width_[axis].resize(all + kChunk);
  }
  if (number_.size() < all + kChunk) {
    number_.resize(all + kChunk);
    std::iota(number_.begin(), number_.end(), 0);
  }
  for_ranges(executor, blocks, [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t b = first; b < last; ++b) quantize_block(b);
  });
}

void ClusterPoints::quantize_block(std::int32_t b) {
  const auto per_point = static_cast<float>(per_unit.point), per_box = static_cast<float>(per_unit.box);
  const auto round_all = [&](const float* from, std::int16_t* to) {
    for (int lane = 0; lane < kBlock; ++lane) to[lane] = rounded(from[lane] * per_point);
  };
  round_all(offsets[b].axis[0], points[b].x);  // whatever empty lanes hold
  round_all(offsets[b].axis[1], points[b].y);
  round_all(offsets[b].axis[2], points[b].z);
  if (!radii.empty()) round_all(radii[b].data(), tags[b].data());
  spans[b] = span_around(corners[b], per_point);
  const BlockSpan box = span_around(corners[b], per_box);
  for (int axis = 0; axis < 3; ++axis) {
    box_center_[axis][b] = box.center[axis];
    box_half_width_[axis][b] = box.half_width[axis];
  }
}

BlockSpan ClusterPoints::span_of(std::int32_t first, std::int32_t last) const {
  return around(first, last, [&](std::int32_t b, int axis) {
    return std::pair<int, int>(spans[b].center[axis], spans[b].half_width[axis]);
  });
}

BlockSpan ClusterPoints::box_of(std::int32_t first, std::int32_t last) const {
  return around(first, last, [&](std::int32_t b, int axis) {
    return std::pair<int, int>(box_center_[axis][b], box_half_width_[axis][b]);
  });
}

BlockSpans ClusterPoints::boxes() const {
  return {{box_center_[0].data(), box_center_[1].data(), box_center_[2].data()},
          {box_half_width_[0].data(), box_half_width_[1].data(), box_half_width_[2].data()},
          number_.data()};
}

std::int16_t ClusterPoints::largest_tag(std::int32_t first, std::int32_t last) const {
  std::int16_t largest = 0;
  for (std::int32_t b = first; b < last; ++b)
    largest = std::max(largest, *std::max_element(tags[b].begin(), tags[b].end()));
  return largest;
}

std::size_t ClusterPoints::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t bytes = bytes_of(number_);
  for (int axis = 0; axis < 3; ++axis) bytes += bytes_of(box_center_[axis]) + bytes_of(box_half_width_[axis]);
  return bytes + bytes_of(clusters) + bytes_of(source) + bytes_of(count) + bytes_of(lanes) +
         bytes_of(offsets) + bytes_of(corners) + bytes_of(radii) + bytes_of(points) + bytes_of(spans) +
         bytes_of(ids) + bytes_of(tags) + bytes_of(owned);
}

#define DCH_INSTANTIATE(Metric)                                                                             \
  template void ClusterPoints::measure(const Metric&, const Level&, PointBlocks&, double, Executor*);       \
  template void ClusterPoints::refresh(const Metric&, const Level&, Span<const Vec3>, PointBlocks&, double, \
                                       Executor*);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
