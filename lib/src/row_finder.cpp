// SPDX-License-Identifier: MIT
#include "row_finder.hpp"

#include <algorithm>
#include <cmath>

#include "metric.hpp"

namespace dch::detail {
namespace {

/// Candidate radii (never decisions) are inflated by this factor.
constexpr double kInflateReach = 1 + 1e-12;
constexpr std::int32_t kGroup = 4;  ///< blocks that are looked at together

std::int32_t rounded_up(std::int32_t n, std::int32_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

}  // namespace

/// The points of blocks near the cluster's box are put side by side, those near the box itself kept, of these
/// for each few of its own blocks those near these, then for each block those near it, and these are tested.
template <class Metric>
void RowFinder::append_rows(const Scene<Metric>& scene, std::int32_t k, NeighborList& out) {
  const ClusterPoints& points = scene.points;
  const Cluster& cluster = points.clusters[k];
  add_ranges(scene, k);
  make_room();
  const std::int32_t count = collect(points, cluster);
  const std::int32_t end = cluster.first_block + cluster.blocks;
  std::int32_t own_before = 0;
  for (std::int32_t first = cluster.first_block; first < end; first += kGroup) {
    const std::int32_t last = std::min(first + kGroup, end);
    const std::int32_t near =
        kernels_->filter(points.span_of(first, last), points.out, around_cluster_.at(own_before), nullptr,
                         count - own_before, around_group_.at(0));
    std::int32_t before = 0;
    for (std::int32_t own = first; own < last; ++own) {
      append_block(scene, own, cluster.owned, before, near, out);
      if (cluster.owned) before += points.count[own];
    }
    own_before += before;
  }
}

// --- clusters near a cluster

void RowFinder::add_range(const ClusterPoints& points, const Cluster& other, Vec3 between) {
  BlockRange range{};
  range.first = other.first_block;
  range.count = other.blocks;
  for (int axis = 0; axis < 3; ++axis) {
    range.box_shift.v[axis] = rounded(between[axis] * points.per_box_unit);
    range.box_shift.v[axis + 4] = static_cast<std::int16_t>(-range.box_shift.v[axis]);
    range.point_shift[axis] = rounded(between[axis] * points.per_point_unit);
  }
  ranges_.push_back(range);
}

/// Each pair of clusters once: in the turn of the one that comes first. A cluster meets itself once, and in
/// each of half of its images.
template <class Metric>
void RowFinder::add_ranges(const Scene<Metric>& scene, std::int32_t k) {
  const std::vector<Cluster>& clusters = scene.points.clusters;
  const std::vector<Vec3>& center = scene.centers.position;
  const Cluster& own = clusters[k];
  ranges_.clear();
  add_range(scene.points, own, Vec3{});
  const auto limit_for = [&](const Cluster& other) {
    return (scene.reach + own.extent + other.extent) * kInflateReach;
  };
  const auto add_if_near = [&](const Cluster& other, Vec3 between) {
    const double limit = limit_for(other);
    if (norm2(between) <= limit * limit) add_range(scene.points, other, between);
  };
  if (scene.one_image) {
    for (const std::int32_t other : scene.centers.edges.row(k))
      if (other > k && (own.owned || clusters[other].owned))
        add_if_near(clusters[other], scene.metric.displacement(center[k], center[other]));
    return;
  }
  const auto add_images = [&](std::int32_t other) {
    const Vec3 nearest = scene.metric.displacement(center[k], center[other]);
    // Along an axis an image n periods from the nearest one is (coordinate + n) heights away.
    int least[3] = {0, 0, 0}, most[3] = {0, 0, 0};
    for (int axis = 0; axis < scene.box.rank(); ++axis) {
      const Vec3 dual = scene.box.reduced_dual()[static_cast<std::size_t>(axis)];
      const double coordinate = dot(nearest, dual),
                   heights = limit_for(clusters[other]) * std::sqrt(norm2(dual));
      least[axis] = static_cast<int>(std::ceil(-coordinate - heights - 1e-9));
      most[axis] = static_cast<int>(std::floor(-coordinate + heights + 1e-9));
    }
    const auto& period = scene.box.reduced();
    for (int a = least[0]; a <= most[0]; ++a)
      for (int b = least[1]; b <= most[1]; ++b)
        for (int c = least[2]; c <= most[2]; ++c) {
          const bool is_later_half = a != 0 ? a > 0 : b != 0 ? b > 0 : c > 0;
          if (other == k && !is_later_half) continue;
          add_if_near(clusters[other], nearest + a * period[0] + b * period[1] + c * period[2]);
        }
  };
  add_images(k);
  for (const std::int32_t other : scene.centers.edges.row(k))
    if (other > k && (own.owned || clusters[other].owned)) add_images(other);
}

// --- points near a cluster

Candidates RowFinder::CandidateStore::at(std::int32_t k) {
  return {x.data() + k, y.data() + k, z.data() + k, id.data() + k};
}

void RowFinder::CandidateStore::make_room(std::size_t count) {
  if (id.size() >= count) return;
  for (auto* axis : {&x, &y, &z}) axis->resize(count);
  id.resize(count);
}

void RowFinder::make_room() {
  std::int32_t most = 0;
  for (const BlockRange& range : ranges_) most += range.count;
  const auto room = static_cast<std::size_t>(rounded_up(most + 1, kBlocksInChunk)) + kBlocksInChunk;
  if (block_.size() >= room) return;
  block_.resize(room);
  range_.resize(room);
  valid_.resize(room / kBlocksInChunk);
  mask_.resize(room / kBlocksInChunk * kBlock);
  unsettled_.resize(room / kBlocksInChunk * kBlock);
  for (CandidateStore* store : {&around_cluster_, &around_group_, &around_block_})
    store->make_room(room * kBlock);
}

/// Fills around_cluster_ and returns how many there are. The cluster's own points come first, in order; if
/// they are all ghosts, points of blocks of ghosts are left out, since two ghosts are no pair.
std::int32_t RowFinder::collect(const ClusterPoints& points, const Cluster& cluster) {
  std::int32_t collected =
      kernels_->collect(cluster.box, points.box_limit, points.boxes.data(), ranges_.data(),
                        static_cast<std::int32_t>(ranges_.size()), block_.data(), range_.data());
  if (!cluster.owned) {
    std::int32_t kept = 0;
    for (std::int32_t n = 0; n < collected; ++n) {
      block_[kept] = block_[n];
      range_[kept] = range_[n];
      kept += points.owned[block_[n]];
    }
    collected = kept;
  }
  kernels_->gather(block_.data(), range_.data(), collected, ranges_.data(), points.points.data(),
                   points.ids.data()->data(), around_cluster_.at(0));
  auto* const lanes = reinterpret_cast<std::uint8_t*>(valid_.data());
  for (std::int32_t n = 0; n < collected; ++n)
    lanes[n] = static_cast<std::uint8_t>((1u << points.count[block_[n]]) - 1);
  return kernels_->filter(cluster.span, points.out, around_cluster_.at(0), valid_.data(), collected * kBlock,
                          around_cluster_.at(0));
}

// --- rows

/// The rows of one block's points, with the candidates around its group from `begin` on, the first of which
/// are these points themselves if the block `meets_itself`.
template <class Metric>
void RowFinder::append_block(const Scene<Metric>& scene, std::int32_t block, bool meets_itself,
                             std::int32_t begin, std::int32_t end, NeighborList& out) {
  const ClusterPoints& points = scene.points;
  const Candidates candidates = around_block_.at(0);
  const std::int32_t count = kernels_->filter(points.spans[block], points.out, around_group_.at(begin),
                                              nullptr, end - begin, candidates);
  const std::int32_t chunks = rounded_up(count, kChunk) / kChunk;
  const std::int32_t left = kernels_->test(points.points[block], candidates, count, points.in, points.out,
                                           mask_.data(), chunks, unsettled_.data());
  const std::int32_t rows = points.count[block];
  const std::array<std::int32_t, kBlock>& ids = points.ids[block];
  for (std::int32_t u = 0; u < left; ++u) {
    const auto [row, chunk, open] = unsettled_[u];
    if (row >= rows) continue;
    for (std::uint32_t rest = open; rest != 0; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      if (meets_itself && chunk == 0 && lane <= row) continue;
      const std::int32_t i = ids[row], j = candidates.id[chunk * kChunk + lane];
      if (scene.filter.accept(i, j, scene.wrapped_distance2(i, j))) mask_[row * chunks + chunk] |= 1u << lane;
    }
  }

  auto written = static_cast<std::size_t>(out.first.back());
  const std::size_t most = written + static_cast<std::size_t>(kBlock * kChunk * chunks + kChunk);
  if (out.j.size() < most) out.j.resize(most + most / 4);
  for (std::int32_t row = 0; row < rows; ++row) {
    if (meets_itself) mask_[row * chunks] &= ~0u << (row + 1);
    std::int32_t* const to = out.j.data() + written;
    std::int32_t length = kernels_->compress(mask_.data() + row * chunks, chunks, candidates.id, to);
    if (scene.filter.restricts(ids[row])) length = restrict_row(ids[row], to, length, scene.filter);
    written += static_cast<std::size_t>(length);
    out.particle.push_back(ids[row]);
    out.first.push_back(static_cast<std::int64_t>(written));
  }
}

/// Types, exclusions and ghosts. Returns how many are left.
std::int32_t RowFinder::restrict_row(std::int32_t particle, std::int32_t* row, std::int32_t count,
                                     const PairFilter& filter) {
  std::int32_t kept = 0;
  for (std::int32_t k = 0; k < count; ++k) {
    const std::int32_t other = row[k];
    row[kept] = other;
    kept += filter.has_one_cutoff() ? filter.is_wanted(particle, other) : filter.accept(particle, other);
  }
  return kept;
}

std::size_t RowFinder::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t bytes = bytes_of(ranges_) + bytes_of(block_) + bytes_of(range_) + bytes_of(valid_) +
                      bytes_of(mask_) + bytes_of(unsettled_);
  for (const CandidateStore* store : {&around_cluster_, &around_group_, &around_block_})
    bytes += 3 * bytes_of(store->x) + bytes_of(store->id);
  return bytes;
}

#define DCH_INSTANTIATE(Metric) \
  template void RowFinder::append_rows(const Scene<Metric>&, std::int32_t, NeighborList&);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
