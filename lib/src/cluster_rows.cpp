// SPDX-License-Identifier: MIT
#include "cluster_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "metric.hpp"

namespace dch::detail {
namespace {

/// Candidate radii (never decisions) are inflated by this factor.
constexpr double kInflateReach = 1 + 1e-12;
constexpr std::int32_t kGroup = 4;  ///< blocks that are looked at together
constexpr double kLargest = 32700;  ///< of a difference of coordinates in units; leaves room for rounding

/// The nearest integer, modulo 2^16.
std::int16_t rounded(float v) {
  const float shifted = v + 0x1.8p23f;  // now the integer stands in the low bits
  std::int32_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
}
std::int16_t rounded(double v) {
  const double shifted = v + 0x1.8p52;
  std::int64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
}

BlockBox box_around(Vec3 low, Vec3 high, double per_unit) {
  BlockBox box{};
  for (int axis = 0; axis < 3; ++axis) {
    box.v[axis] = static_cast<std::int16_t>(rounded(low[axis] * per_unit) - 1);
    box.v[axis + 4] = static_cast<std::int16_t>(-rounded(high[axis] * per_unit) - 1);
  }
  return box;
}

/// Holds the rounded points between the corners.
BlockSpan span_around(Vec3 low, Vec3 high, double per_unit) {
  BlockSpan span{};
  for (int axis = 0; axis < 3; ++axis) {
    span.center[axis] = rounded(0.5 * (low[axis] + high[axis]) * per_unit);
    span.half_width[axis] = static_cast<std::int16_t>(rounded(0.5 * (high[axis] - low[axis]) * per_unit) + 2);
  }
  return span;
}

std::int32_t rounded_up(std::int32_t n, std::int32_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

}  // namespace

template <class Metric>
void ClusterRows::find(const Metric& metric, const Box& box, const Level& clusters, const PointBlocks& points,
                       Span<const std::int32_t> slot_of_id, std::int32_t first_ghost, double error,
                       const PairFilter& filter, NeighborList& out) {
  kernels_ = &list_kernels(instruction_set());
  out.kind = ListKind::half;
  out.first.assign(1, 0);
  out.particle.clear();
  out.j.resize(out.j.capacity());
  const double reach = std::sqrt(filter.largest_distance2());
  // Two images of a point may both be within the band of the cutoff only if it is half a period.
  if (box.any_periodic() && (reach + 2 * error) * kInflateReach >= box.max_cutoff())
    return find_by_distance(metric, clusters, points, filter, out);
  one_image_ = !box.any_periodic() || (reach + 2 * largest_extent_) * kInflateReach < box.max_cutoff();
  quantize(points, first_ghost, reach, error);
  const auto wrapped_distance2 = [&](std::int32_t i, std::int32_t j) {
    return metric.distance2(points.position[slot_of_id[i]], points.position[slot_of_id[j]]);
  };
  for (std::int32_t k = 0; k < clusters.size(); ++k) {
    if (!clusters.is_alive(k)) continue;
    add_ranges(metric, box, clusters, k, reach);
    find_rows(clusters_[k], filter, wrapped_distance2, out);
  }
}

// --- coordinates relative to the centers

template <class Metric>
void ClusterRows::measure(const Metric& metric, const Level& clusters, const PointBlocks& points) {
  clusters_.assign(clusters.position.size(), Cluster());
  const std::size_t most = points.cluster.size();
  source_.resize(most);
  counts_.resize(most);
  low_.resize(most);
  high_.resize(most);
  offset_.resize(most * kBlock);
  largest_extent_ = largest_width_ = largest_size_ = 0;
  std::int32_t blocks = 0;
  for (std::int32_t k = 0; k < clusters.size(); ++k) {
    if (!clusters.is_alive(k)) continue;
    const Vec3 center = clusters.position[k];
    Cluster& cluster = clusters_[k];
    cluster.first_block = blocks;
    double extent2 = 0;
    Vec3 cluster_low{}, cluster_high{};  // the center is in the box
    for (std::int32_t block = clusters.first_child[k]; block != kNone; block = points.next[block]) {
      Offset* to = offset_.data() + static_cast<std::size_t>(blocks) * kBlock;
      const Vec3* from = points.position.data() + static_cast<std::size_t>(block) * kBlock;
      Vec3 low = metric.displacement(center, from[0]), high = low;
      const std::int32_t count = points.count[block];
      for (std::int32_t lane = 0; lane < count; ++lane) {
        const Vec3 at = metric.displacement(center, from[lane]);
        to[lane] = {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
        extent2 = std::max(extent2, norm2(at));
        low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
      }
      const Vec3 size = high - low;
      largest_size_ = std::max(largest_size_, std::max(size.x, std::max(size.y, size.z)));
      low_[blocks] = low;
      high_[blocks] = high;
      cluster_low = {std::min(cluster_low.x, low.x), std::min(cluster_low.y, low.y),
                     std::min(cluster_low.z, low.z)};
      cluster_high = {std::max(cluster_high.x, high.x), std::max(cluster_high.y, high.y),
                      std::max(cluster_high.z, high.z)};
      source_[blocks] = block;
      counts_[blocks++] = static_cast<std::uint8_t>(count);
    }
    const Vec3 width = cluster_high - cluster_low;
    largest_width_ = std::max(largest_width_, std::max(width.x, std::max(width.y, width.z)));
    cluster.blocks = blocks - cluster.first_block;
    cluster.extent = std::sqrt(extent2);
    largest_extent_ = std::max(largest_extent_, cluster.extent);
  }
  blocks_ = blocks;
}

// Errors, with all lengths in units: a difference of coordinates is off by at most 3/2 along each axis (two
// points and a shift, each rounded; rounding in float adds 0.03 to the distance at most), hence a distance d
// <= reach by sqrt(3) 3/2, and its square by 3 sqrt(3) reach + 27/4; halved 15 times over, and three
// roundings of 1/2 added.
void ClusterRows::quantize(const PointBlocks& points, std::int32_t first_ghost, double reach, double error) {
  // The largest difference of coordinates that is taken: between a point of a cluster and one within reach of
  // the cluster's box, or between the middle of the box and a point of a block within reach of it.
  const double widest = reach + std::max(largest_width_, 0.5 * largest_width_ + largest_size_);
  point_unit_ = widest * (1 + 1e-9) / kLargest;
  box_unit_ = (reach + 6 * largest_extent_) * (1 + 1e-9) / kLargest;
  const double in_units = reach / point_unit_;
  const double limit = in_units * in_units / 0x1p15;
  const double off = std::sqrt(27.0) / 2 + 0.03 + 2 * error / point_unit_;
  const double band = (2 * off * in_units + off * off) / 0x1p15 + 1.5 + 1e-6;
  in_ = static_cast<std::int16_t>(std::clamp(std::floor(limit - band) + 1, 0.0, 32767.0));
  out_ = static_cast<std::int16_t>(std::clamp(std::floor(limit + band) + 1, 0.0, 32767.0));
  // Box corners are rounded outward; their shift and the squares are rounded too.
  const double box_reach = reach / box_unit_ + 2;
  box_limit_ = static_cast<std::int16_t>(std::min(std::ceil(box_reach * box_reach / 0x1p15 + 1.5), 32767.0));

  const auto blocks = static_cast<std::size_t>(blocks_);
  points_.resize(blocks);
  boxes_.resize(blocks);
  ids_.resize(blocks);
  spans_.resize(blocks);
  owned_.assign(blocks, first_ghost < 0);
  per_point_unit_ = 1 / point_unit_;
  per_box_unit_ = 1 / box_unit_;
  const auto per_unit = static_cast<float>(per_point_unit_);
  for (Cluster& cluster : clusters_) {
    Vec3 low{}, high{};
    cluster.owned = first_ghost < 0;
    for (std::int32_t b = cluster.first_block; b < cluster.first_block + cluster.blocks; ++b) {
      const Offset* at = offset_.data() + static_cast<std::size_t>(b) * kBlock;
      for (int lane = 0; lane < kBlock; ++lane) {  // whatever empty lanes hold
        points_[b].x[lane] = rounded(at[lane].x * per_unit);
        points_[b].y[lane] = rounded(at[lane].y * per_unit);
        points_[b].z[lane] = rounded(at[lane].z * per_unit);
      }
      boxes_[b] = box_around(low_[b], high_[b], per_box_unit_);
      spans_[b] = span_around(low_[b], high_[b], per_point_unit_);
      std::copy_n(points.id.data() + static_cast<std::size_t>(source_[b]) * kBlock, kBlock, ids_[b].data());
      for (int lane = 0; lane < counts_[b] && !owned_[b]; ++lane) owned_[b] = ids_[b][lane] < first_ghost;
      cluster.owned |= owned_[b] != 0;
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], low_[b][axis]);
        high[axis] = std::max(high[axis], high_[b][axis]);
      }
    }
    cluster.box = box_around(low, high, per_box_unit_);
    cluster.span = span_around(low, high, per_point_unit_);
  }
}

// --- clusters near a cluster

void ClusterRows::add_range(const Cluster& other, Vec3 between) {
  BlockRange range{};
  range.first = other.first_block;
  range.count = other.blocks;
  for (int axis = 0; axis < 3; ++axis) {
    range.box_shift.v[axis] = rounded(between[axis] * per_box_unit_);
    range.box_shift.v[axis + 4] = static_cast<std::int16_t>(-range.box_shift.v[axis]);
    range.point_shift[axis] = rounded(between[axis] * per_point_unit_);
  }
  ranges_.push_back(range);
}

/// Each pair of clusters once: in the turn of the one that comes first. A cluster meets itself once, and in
/// each of half of its images.
template <class Metric>
void ClusterRows::add_ranges(const Metric& metric, const Box& box, const Level& clusters, std::int32_t k,
                             double reach) {
  ranges_.clear();
  const Cluster& own = clusters_[k];
  add_range(own, Vec3{});
  const auto is_near = [&](const Cluster& other, Vec3 between) {
    const double limit = (reach + own.extent + other.extent) * kInflateReach;
    return norm2(between) <= limit * limit;
  };
  if (one_image_) {
    for (const std::int32_t other : clusters.edges.row(k)) {
      if (other <= k || !(own.owned || clusters_[other].owned)) continue;
      const Vec3 between = metric.displacement(clusters.position[k], clusters.position[other]);
      if (is_near(clusters_[other], between)) add_range(clusters_[other], between);
    }
    return;
  }
  const auto add_images = [&](std::int32_t other) {
    const Vec3 nearest = metric.displacement(clusters.position[k], clusters.position[other]);
    const double limit = (reach + own.extent + clusters_[other].extent) * kInflateReach;
    // Along an axis an image n periods from the nearest one is (coordinate + n) heights away.
    int least[3] = {0, 0, 0}, most[3] = {0, 0, 0};
    for (int axis = 0; axis < box.rank(); ++axis) {
      const Vec3 dual = box.reduced_dual()[static_cast<std::size_t>(axis)];
      const double coordinate = dot(nearest, dual), heights = limit * std::sqrt(norm2(dual));
      least[axis] = static_cast<int>(std::ceil(-coordinate - heights - 1e-9));
      most[axis] = static_cast<int>(std::floor(-coordinate + heights + 1e-9));
    }
    const auto& period = box.reduced();
    for (int a = least[0]; a <= most[0]; ++a)
      for (int b = least[1]; b <= most[1]; ++b)
        for (int c = least[2]; c <= most[2]; ++c) {
          const bool is_later_half = a != 0 ? a > 0 : b != 0 ? b > 0 : c > 0;
          if (other == k && !is_later_half) continue;
          const Vec3 between = nearest + a * period[0] + b * period[1] + c * period[2];
          if (is_near(clusters_[other], between)) add_range(clusters_[other], between);
        }
  };
  add_images(k);
  for (const std::int32_t other : clusters.edges.row(k))
    if (other > k && (own.owned || clusters_[other].owned)) add_images(other);
}

// --- rows

Candidates ClusterRows::CandidateStore::at(std::int32_t k) {
  return {x.data() + k, y.data() + k, z.data() + k, id.data() + k};
}

void ClusterRows::CandidateStore::make_room(std::size_t count) {
  if (id.size() >= count) return;
  for (auto* axis : {&x, &y, &z}) axis->resize(count);
  id.resize(count);
}

/// The rows of a cluster's points: with each other and with the points of the clusters after it. The points
/// of blocks near the cluster's box are put side by side, those near the box itself kept, of these for each
/// of its own blocks those near that one's box, and these are tested.
template <class Distance2>
void ClusterRows::find_rows(const Cluster& cluster, const PairFilter& filter,
                            const Distance2& wrapped_distance2, NeighborList& out) {
  std::int32_t most = 0;
  for (const BlockRange& range : ranges_) most += range.count;
  const auto room = static_cast<std::size_t>(rounded_up(most + 1, kBlocksInChunk)) + kBlocksInChunk;
  if (block_.size() < room) {
    block_.resize(room);
    range_.resize(room);
    valid_.resize(room / kBlocksInChunk);
    mask_.resize(room / kBlocksInChunk * kBlock);
    unsettled_.resize(room / kBlocksInChunk * kBlock);
    around_cluster_.make_room(room * kBlock);
    around_group_.make_room(room * kBlock);
    around_block_.make_room(room * kBlock);
  }
  std::int32_t collected =
      kernels_->collect(cluster.box, box_limit_, boxes_.data(), ranges_.data(),
                        static_cast<std::int32_t>(ranges_.size()), block_.data(), range_.data());
  if (!cluster.owned) collected = keep_owned_blocks(collected);
  kernels_->gather(block_.data(), range_.data(), collected, ranges_.data(), points_.data(),
                   ids_.data()->data(), around_cluster_.at(0));
  auto* const lanes = reinterpret_cast<std::uint8_t*>(valid_.data());
  for (std::int32_t n = 0; n < collected; ++n)
    lanes[n] = static_cast<std::uint8_t>((1u << counts_[block_[n]]) - 1);
  const std::int32_t count = kernels_->filter(cluster.span, out_, around_cluster_.at(0), valid_.data(),
                                              collected * kBlock, around_cluster_.at(0));
  // First for a few blocks that lie together, so that each has less to look through.
  std::int32_t own_before = 0;
  for (std::int32_t first = cluster.first_block; first < cluster.first_block + cluster.blocks;
       first += kGroup) {
    const std::int32_t last = std::min(first + kGroup, cluster.first_block + cluster.blocks);
    const std::int32_t near =
        kernels_->filter(span_of_blocks(first, last), out_, around_cluster_.at(own_before), nullptr,
                         count - own_before, around_group_.at(0));
    std::int32_t before = 0;
    for (std::int32_t own = first; own < last; ++own) {
      row_block(own, cluster.owned, before, near, filter, wrapped_distance2, out);
      if (cluster.owned) before += counts_[own];
    }
    own_before += before;
  }
}

BlockSpan ClusterRows::span_of_blocks(std::int32_t first, std::int32_t last) const {
  Vec3 low = low_[first], high = high_[first];
  for (std::int32_t b = first + 1; b < last; ++b) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], low_[b][axis]);
      high[axis] = std::max(high[axis], high_[b][axis]);
    }
  }
  return span_around(low, high, per_point_unit_);
}

/// Two ghosts are no pair. Returns how many blocks are left.
std::int32_t ClusterRows::keep_owned_blocks(std::int32_t collected) {
  std::int32_t kept = 0;
  for (std::int32_t n = 0; n < collected; ++n) {
    block_[kept] = block_[n];
    range_[kept] = range_[n];
    kept += owned_[block_[n]];
  }
  return kept;
}

/// The rows of one block's points, with the candidates around its group from `begin` on, the first of which
/// are these points themselves if the block `meets_itself`.
template <class Distance2>
void ClusterRows::row_block(std::int32_t block, bool meets_itself, std::int32_t begin, std::int32_t end,
                            const PairFilter& filter, const Distance2& wrapped_distance2, NeighborList& out) {
  const Candidates candidates = around_block_.at(0);
  const std::int32_t count =
      kernels_->filter(spans_[block], out_, around_group_.at(begin), nullptr, end - begin, candidates);
  const std::int32_t chunks = rounded_up(count, kChunk) / kChunk;
  const std::int32_t left =
      kernels_->test(points_[block], candidates, count, in_, out_, mask_.data(), chunks, unsettled_.data());
  const std::int32_t rows = counts_[block];
  const std::array<std::int32_t, kBlock>& ids = ids_[block];
  for (std::int32_t u = 0; u < left; ++u) {
    const auto [row, chunk, open] = unsettled_[u];
    if (row >= rows) continue;
    for (std::uint32_t rest = open; rest != 0; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      if (meets_itself && chunk == 0 && lane <= row) continue;
      const std::int32_t i = ids[row], j = candidates.id[chunk * kChunk + lane];
      if (filter.accept(i, j, wrapped_distance2(i, j))) mask_[row * chunks + chunk] |= 1u << lane;
    }
  }

  auto written = static_cast<std::size_t>(out.first.back());
  const std::size_t most = written + static_cast<std::size_t>(kBlock * kChunk * chunks + kChunk);
  if (out.j.size() < most) out.j.resize(most + most / 4);
  for (std::int32_t row = 0; row < rows; ++row) {
    if (meets_itself) mask_[row * chunks] &= ~0u << (row + 1);
    std::int32_t* const to = out.j.data() + written;
    std::int32_t length = kernels_->compress(mask_.data() + row * chunks, chunks, candidates.id, to);
    if (filter.restricts(ids[row])) length = restrict_row(ids[row], to, length, filter);
    written += static_cast<std::size_t>(length);
    out.particle.push_back(ids[row]);
    out.first.push_back(static_cast<std::int64_t>(written));
  }
}

/// Types, exclusions and ghosts. Returns how many are left.
std::int32_t ClusterRows::restrict_row(std::int32_t particle, std::int32_t* row, std::int32_t count,
                                       const PairFilter& filter) const {
  std::int32_t kept = 0;
  for (std::int32_t k = 0; k < count; ++k) {
    const std::int32_t other = row[k];
    row[kept] = other;
    kept += filter.has_one_cutoff() ? filter.is_wanted(particle, other) : filter.accept(particle, other);
  }
  return kept;
}

/// Where lists reach half the box, with the nearest image found pair by pair.
template <class Metric>
void ClusterRows::find_by_distance(const Metric& metric, const Level& clusters, const PointBlocks& points,
                                   const PairFilter& filter, NeighborList& out) {
  std::vector<std::int32_t> own, others;
  for (std::int32_t k = 0; k < clusters.size(); ++k) {
    if (!clusters.is_alive(k)) continue;
    others.clear();
    const auto collect = [&](std::int32_t slot) { others.push_back(slot); };
    points.for_each(clusters.first_child[k], collect);
    own = others;
    for (const std::int32_t other : clusters.edges.row(k))
      if (other > k) points.for_each(clusters.first_child[other], collect);
    for (std::size_t a = 0; a < own.size(); ++a) {
      auto end = static_cast<std::size_t>(out.first.back());
      if (out.j.size() < end + others.size()) out.j.resize(2 * (end + others.size()));
      const std::int32_t i = points.id[own[a]];
      for (std::size_t b = a + 1; b < others.size(); ++b) {
        const std::int32_t j = points.id[others[b]];
        out.j[end] = j;
        end += filter.accept(i, j, metric.distance2(points.position[own[a]], points.position[others[b]]));
      }
      out.particle.push_back(i);
      out.first.push_back(static_cast<std::int64_t>(end));
    }
  }
}

std::size_t ClusterRows::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t bytes = bytes_of(clusters_) + bytes_of(source_) + bytes_of(offset_) + bytes_of(points_) +
                      bytes_of(boxes_) + bytes_of(spans_) + bytes_of(ids_) + bytes_of(low_) +
                      bytes_of(high_) + bytes_of(counts_) + bytes_of(owned_) + bytes_of(ranges_) +
                      bytes_of(block_) + bytes_of(range_) + bytes_of(valid_) + bytes_of(mask_) +
                      bytes_of(unsettled_);
  for (const CandidateStore* store : {&around_cluster_, &around_group_, &around_block_})
    bytes += 3 * bytes_of(store->x) + bytes_of(store->id);
  return bytes;
}

#define DCH_INSTANTIATE(Metric)                                                                      \
  template void ClusterRows::measure(const Metric&, const Level&, const PointBlocks&);               \
  template void ClusterRows::find(const Metric&, const Box&, const Level&, const PointBlocks&,       \
                                  Span<const std::int32_t>, std::int32_t, double, const PairFilter&, \
                                  NeighborList&);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
