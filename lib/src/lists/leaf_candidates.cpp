// SPDX-License-Identifier: MIT
#include "lists/leaf_candidates.hpp"

#include <algorithm>

#include <dch/base/index_count.hpp>

#include "geometry/metric.hpp"

namespace dch::detail {

/// Fills ranges_.
template <class Metric>
void LeafCandidates::find_ranges(const LeafScene<Metric>& scene, std::int32_t k) {
  ranges_.resize(scene.near.size());
  for (std::size_t s = 0; s < scene.near.size(); ++s) {
    NearRanges<Metric> ranges(scene.metric, scene.box, scene.rows(), k, ranges_[s]);
    if (s == 0) {
      ranges.find_own(scene.near[s]);
    } else {
      work_.nodes += ranges.find_others(scene.near[s]);
    }
  }
}

/// Fills around_ and returns how many there are. The part's own points come first, in order, then those
/// of the leaf's parts after it.
template <class Metric>
std::int32_t LeafCandidates::collect(const LeafScene<Metric>& scene, const Part& part) {
  const BlockSpan span = part.own.span_of(0, part.own.blocks);
  const std::int16_t size = part.own.largest_tag(0, part.own.blocks);
  const BlockSpan box = scene.rows().quantized.box_of(part.first, part.last);
  BlockRange& own = ranges_[0][0];
  own.count -= part.first - own.first;
  own.first = part.first;
  std::int32_t count = 0;
  for (std::size_t s = 0; s < scene.near.size(); ++s) {
    const std::int32_t collected =
        collect_from(scene.near[s], ranges_[s], box, part.own.are_candidates, count);
    work_.gathered += std::int64_t{kBlock} * collected;
    count += keep_near(*kernels_, scene.requests[0].limits, span, size, around_.at(count), valid_.data(),
                       collected * kBlock, around_.at(count));
  }
  return count;
}

/// Puts the points of blocks near the box behind those that there are `already`, and returns the number of
/// blocks. If the leaf's points are all ghosts, blocks of ghosts are left out, since two ghosts are no
/// pair.
std::int32_t LeafCandidates::collect_from(const NearSource& near, const std::vector<BlockRange>& ranges,
                                          const BlockSpan& box, bool owned, std::int32_t already) {
  const LeafSource& leaves = *near.source;
  std::int64_t lanes_near = already;
  for (const BlockRange& range : ranges) lanes_near += std::int64_t{kBlock} * range.count;
  index_count(lanes_near, "points and images of points near one leaf", "take a smaller cutoff",
              kMaxIndexCount - 2 * kChunk);  // as many as that are rounded up to whole chunks
  const auto most = static_cast<std::int32_t>((lanes_near - already) / kBlock);
  work_.boxes += most;
  const auto blocks = static_cast<std::size_t>(rounded_up(most, kBlocksInChunk)) + kChunk;
  if (block_room_ < blocks) {
    block_.resize(blocks);
    valid_.resize(blocks / kBlocksInChunk);
    block_room_ = blocks;
  }
  range_end_.resize(std::max(range_end_.size(), ranges.size()));

  const auto range_count = static_cast<std::int32_t>(ranges.size());
  std::int32_t collected = kernels_->collect(box, near.box_limit, leaves.quantized.boxes(), ranges.data(),
                                             range_count, block_.data(), range_end_.data());
  if (!owned) collected = leave_out_ghosts(leaves, range_count);
  around_.make_room(static_cast<std::size_t>(already) + static_cast<std::size_t>(collected) * kBlock +
                    kChunk);
  kernels_->gather(block_.data(), range_end_.data(), ranges.data(), range_count,
                   leaves.quantized.points.data(), leaves.particles()->data(),
                   leaves.tags() == nullptr ? nullptr : leaves.tags()->data(), around_.at(already));
  auto* const lanes = reinterpret_cast<std::uint8_t*>(valid_.data());
  for (std::int32_t n = 0; n < collected; ++n) lanes[n] = leaves.measured().lanes[block_[n]];
  return collected;
}

/// Of the blocks that have been collected.
std::int32_t LeafCandidates::leave_out_ghosts(const LeafSource& leaves, std::int32_t range_count) {
  std::int32_t kept = 0, n = 0;
  for (std::int32_t r = 0; r < range_count; ++r) {
    for (; n < range_end_[r]; ++n) {
      block_[kept] = block_[n];
      kept += leaves.labelled.owned[block_[n]];
    }
    range_end_[r] = kept;
  }
  return kept;
}

std::size_t LeafCandidates::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t bytes = bytes_of(block_) + bytes_of(range_end_) + bytes_of(valid_) + around_.memory_bytes();
  for (const std::vector<BlockRange>& ranges : ranges_) bytes += bytes_of(ranges);
  return bytes;
}

#define DCH_INSTANTIATE(Metric)                                                      \
  template void LeafCandidates::find_ranges(const LeafScene<Metric>&, std::int32_t); \
  template std::int32_t LeafCandidates::collect(const LeafScene<Metric>&, const Part&);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
