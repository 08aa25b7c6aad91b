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
constexpr double kLargest = 32700;  ///< of a difference of coordinates in units; leaves room for rounding

/// The nearest integer, modulo 2^16.
std::int16_t rounded(double v) {
  const double shifted = v + 0x1.8p52;  // now the integer stands in the low bits
  std::int64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
}

BlockBox box_around(Vec3 low, Vec3 high, double unit) {
  BlockBox box{};
  for (int axis = 0; axis < 3; ++axis) {
    box.v[axis] = static_cast<std::int16_t>(rounded(low[axis] / unit) - 1);
    box.v[axis + 4] = static_cast<std::int16_t>(-rounded(high[axis] / unit) - 1);
  }
  return box;
}

std::int32_t rounded_up(std::int32_t n, std::int32_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

}  // namespace

template <class Metric>
void ClusterRows::find(const Metric& metric, const Box& box, const Level& clusters, const PointBlocks& points,
                       std::int32_t first_ghost, double error, const PairFilter& filter, NeighborList& out) {
  kernels_ = &list_kernels(instruction_set());
  out.kind = ListKind::half;
  out.first.assign(1, 0);
  out.particle.clear();
  out.j.resize(out.j.capacity());
  const double reach = std::sqrt(filter.largest_distance2());
  // Two images of a point may both be within the band of the cutoff only if it is half a period.
  if (box.any_periodic() && (reach + 2 * error) * kInflateReach >= box.max_cutoff())
    return find_by_distance(metric, clusters, points, filter, out);
  measure(metric, clusters, points, first_ghost);
  one_image_ = !box.any_periodic() || (reach + 2 * largest_extent_) * kInflateReach < box.max_cutoff();
  quantize(points, reach, error);
  for (std::int32_t k = 0; k < clusters.size(); ++k) {
    if (!clusters.is_alive(k)) continue;
    add_ranges(metric, box, clusters, k, reach);
    find_rows(clusters_[k], filter, out);
  }
}

// --- coordinates relative to the centers

template <class Metric>
void ClusterRows::measure(const Metric& metric, const Level& clusters, const PointBlocks& points,
                          std::int32_t first_ghost) {
  clusters_.assign(clusters.position.size(), Cluster());
  source_.clear();
  offset_.resize(points.position.size() + kBlock);
  largest_extent_ = largest_size_ = 0;
  lanes_.clear();
  owned_.clear();
  for (std::int32_t k = 0; k < clusters.size(); ++k) {
    if (!clusters.is_alive(k)) continue;
    const Vec3 center = clusters.position[k];
    Cluster& cluster = clusters_[k];
    cluster.first_block = static_cast<std::int32_t>(source_.size());
    cluster.owned = first_ghost < 0;
    double extent2 = 0;
    for (std::int32_t block = clusters.first_child[k]; block != kNone; block = points.next[block]) {
      Vec3* to = offset_.data() + source_.size() * kBlock;
      Vec3 low{}, high{};
      bool owned = first_ghost < 0;
      for (std::int32_t lane = 0; lane < points.count[block]; ++lane) {
        const std::int32_t slot = block * kBlock + lane;
        const Vec3 at = metric.displacement(center, points.position[slot]);
        to[lane] = at;
        extent2 = std::max(extent2, norm2(at));
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = lane == 0 ? at[axis] : std::min(low[axis], at[axis]);
          high[axis] = lane == 0 ? at[axis] : std::max(high[axis], at[axis]);
        }
        owned |= points.id[slot] < first_ghost;
      }
      for (int axis = 0; axis < 3; ++axis) largest_size_ = std::max(largest_size_, high[axis] - low[axis]);
      source_.push_back(block);
      lanes_.push_back(static_cast<std::uint8_t>(points.count[block]));
      owned_.push_back(owned);
      cluster.owned |= owned;
    }
    cluster.blocks = static_cast<std::int32_t>(source_.size()) - cluster.first_block;
    cluster.extent = std::sqrt(extent2);
    largest_extent_ = std::max(largest_extent_, cluster.extent);
  }
}

// Errors, with all lengths in units: a difference of coordinates is off by at most 3/2 along each axis (two
// points and a shift, each rounded), hence a distance d <= reach by sqrt(3) 3/2, and its square by
// 3 sqrt(3) reach + 27/4; halved 15 times over, and three roundings of 1/2 added.
void ClusterRows::quantize(const PointBlocks& points, double reach, double error) {
  point_unit_ = (reach + 2 * largest_size_) * (1 + 1e-9) / kLargest;
  box_unit_ = (reach + 6 * largest_extent_) * (1 + 1e-9) / kLargest;
  const double in_units = reach / point_unit_;
  const double limit = in_units * in_units / 0x1p15;
  const double off = std::sqrt(27.0) / 2 + 2 * error / point_unit_;
  const double band = (2 * off * in_units + off * off) / 0x1p15 + 1.5 + 1e-6;
  in_ = static_cast<std::int16_t>(std::clamp(std::floor(limit - band) + 1, 0.0, 32767.0));
  out_ = static_cast<std::int16_t>(std::clamp(std::floor(limit + band) + 1, 0.0, 32767.0));
  // Box corners are rounded outward; their shift and the squares are rounded too.
  const double box_reach = reach / box_unit_ + 2;
  box_limit_ = static_cast<std::int16_t>(std::min(std::ceil(box_reach * box_reach / 0x1p15 + 1.5), 32767.0));

  const std::size_t blocks = source_.size();
  points_.resize(blocks);
  boxes_.resize(blocks);
  ids_.resize(blocks);
  const double per_unit = 1 / point_unit_;
  for (Cluster& cluster : clusters_) {
    Vec3 cluster_low{}, cluster_high{};
    for (std::int32_t b = cluster.first_block; b < cluster.first_block + cluster.blocks; ++b) {
      const Vec3* at = offset_.data() + static_cast<std::size_t>(b) * kBlock;
      Vec3 low = at[0], high = at[0];
      for (int lane = 0; lane < lanes_[b]; ++lane) {
        points_[b].x[lane] = rounded(at[lane].x * per_unit);
        points_[b].y[lane] = rounded(at[lane].y * per_unit);
        points_[b].z[lane] = rounded(at[lane].z * per_unit);
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = std::min(low[axis], at[lane][axis]);
          high[axis] = std::max(high[axis], at[lane][axis]);
        }
      }
      boxes_[b] = box_around(low, high, box_unit_);
      std::copy_n(points.id.data() + static_cast<std::size_t>(source_[b]) * kBlock, kBlock, ids_[b].data());
      for (int axis = 0; axis < 3; ++axis) {
        cluster_low[axis] = std::min(cluster_low[axis], low[axis]);
        cluster_high[axis] = std::max(cluster_high[axis], high[axis]);
      }
    }
    cluster.box = box_around(cluster_low, cluster_high, box_unit_);
  }
}

// --- clusters near a cluster

void ClusterRows::add_range(const Cluster& other, Vec3 between) {
  BlockRange range{};
  range.first = other.first_block;
  range.count = other.blocks;
  for (int axis = 0; axis < 3; ++axis) {
    range.box_shift.v[axis] = rounded(between[axis] / box_unit_);
    range.box_shift.v[axis + 4] = static_cast<std::int16_t>(-range.box_shift.v[axis]);
    range.point_shift[axis] = rounded(between[axis] / point_unit_);
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

void ClusterRows::find_rows(const Cluster& cluster, const PairFilter& filter, NeighborList& out) {
  std::int32_t most = 0;
  for (const BlockRange& range : ranges_) most += range.count;
  const auto room = static_cast<std::size_t>(rounded_up(most + 1, kChunk));
  if (block_.size() < room) {
    block_.resize(room);
    range_.resize(room);
    index_.resize(room);
    for (auto& corner : corners_) corner.resize(room);
    for (auto* axis : {&x_, &y_, &z_}) axis->resize(room * kBlock);
    candidate_.resize(room * kBlock);
    valid_.resize(room / kBlocksInChunk);
    mask_.resize(room / kBlocksInChunk * kBlock);
    unsettled_.resize(room / kBlocksInChunk * kBlock);
  }
  BoxColumns columns;
  for (std::size_t c = 0; c < 6; ++c) columns.corner[c] = corners_[c].data();
  const std::int32_t collected =
      kernels_->collect(cluster.box, box_limit_, boxes_.data(), ranges_.data(),
                        static_cast<std::int32_t>(ranges_.size()), block_.data(), range_.data(), columns);
  for (std::int32_t own = 0; own < cluster.blocks; ++own)
    row_block(cluster.first_block + own, own, collected, filter, out);
}

/// The rows of one block's points: with each other and with the blocks collected after it.
void ClusterRows::row_block(std::int32_t block, std::int32_t own_index, std::int32_t collected,
                            const PairFilter& filter, NeighborList& out) {
  BoxColumns columns;
  for (std::size_t c = 0; c < 6; ++c) columns.corner[c] = corners_[c].data();
  const std::int32_t near =
      kernels_->select(boxes_[block], box_limit_, columns, own_index, collected, index_.data());

  auto* const lanes = reinterpret_cast<std::uint8_t*>(valid_.data());
  std::int32_t kept = 0;
  for (std::int32_t n = 0; n < near; ++n) {
    const std::int32_t other = block_[index_[n]];
    if (!owned_[block] && !owned_[other]) continue;
    const std::int16_t* shift = ranges_[range_[index_[n]]].point_shift;
    const BlockPoints& from = points_[other];
    for (int lane = 0; lane < kBlock; ++lane) {
      x_[kept * kBlock + lane] = static_cast<std::int16_t>(from.x[lane] + shift[0]);
      y_[kept * kBlock + lane] = static_cast<std::int16_t>(from.y[lane] + shift[1]);
      z_[kept * kBlock + lane] = static_cast<std::int16_t>(from.z[lane] + shift[2]);
    }
    std::copy_n(ids_[other].data(), kBlock, candidate_.data() + kept * kBlock);
    lanes[kept] = static_cast<std::uint8_t>((1u << lanes_[other]) - 1);
    ++kept;
  }
  const std::int32_t chunks = rounded_up(kept, kBlocksInChunk) / kBlocksInChunk;
  for (std::int32_t pad = kept; pad < chunks * kBlocksInChunk; ++pad) lanes[pad] = 0;

  const std::int32_t left = kernels_->test(points_[block], x_.data(), y_.data(), z_.data(), valid_.data(),
                                           chunks, in_, out_, mask_.data(), chunks, unsettled_.data());
  const bool meets_itself = owned_[block];  // then it is the first one kept
  const auto is_earlier = [&](std::int32_t row, std::int32_t chunk, int lane) {
    return meets_itself && chunk == 0 && lane <= row;
  };
  for (std::int32_t u = 0; u < left; ++u) {
    const auto [row, chunk, open] = unsettled_[u];
    if (row >= lanes_[block]) continue;
    for (std::uint32_t rest = open; rest != 0; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      if (is_earlier(row, chunk, lane)) continue;
      if (filter.accept(ids_[block][row], candidate_[chunk * kChunk + lane]))
        mask_[row * chunks + chunk] |= 1u << lane;
    }
  }

  auto end = static_cast<std::size_t>(out.first.back());
  const std::size_t most = end + static_cast<std::size_t>(kBlock * kChunk * chunks + kChunk);
  if (out.j.size() < most) out.j.resize(most + most / 4);
  for (std::int32_t row = 0; row < lanes_[block]; ++row) {
    if (meets_itself) mask_[row * chunks] &= ~0u << (row + 1);
    std::int32_t* const to = out.j.data() + end;
    std::int32_t count = kernels_->compress(mask_.data() + row * chunks, chunks, candidate_.data(), to);
    if (!filter.is_plain()) count = restrict_row(ids_[block][row], to, count, filter);
    end += static_cast<std::size_t>(count);
    out.particle.push_back(ids_[block][row]);
    out.first.push_back(static_cast<std::int64_t>(end));
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
  std::size_t bytes = clusters_.capacity() * sizeof(Cluster) + offset_.capacity() * sizeof(Vec3) +
                      points_.capacity() * sizeof(BlockPoints) + boxes_.capacity() * sizeof(BlockBox) +
                      ids_.capacity() * sizeof(ids_[0]) + lanes_.capacity() + owned_.capacity() +
                      ranges_.capacity() * sizeof(BlockRange) + unsettled_.capacity() * sizeof(Unsettled);
  for (const auto* of : {&source_, &block_, &range_, &index_, &candidate_})
    bytes += of->capacity() * sizeof(std::int32_t);
  for (const auto& corner : corners_) bytes += corner.capacity() * sizeof(std::int16_t);
  for (const auto* axis : {&x_, &y_, &z_}) bytes += axis->capacity() * sizeof(std::int16_t);
  return bytes + (valid_.capacity() + mask_.capacity()) * sizeof(std::uint32_t);
}

#define DCH_INSTANTIATE(Metric)                                                                              \
  template void ClusterRows::find(const Metric&, const Box&, const Level&, const PointBlocks&, std::int32_t, \
                                  double, const PairFilter&, NeighborList&);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
