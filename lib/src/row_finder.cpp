// SPDX-License-Identifier: MIT
#include "row_finder.hpp"

#include <algorithm>

#include "metric.hpp"

namespace dch::detail {
namespace {

constexpr std::size_t kFewExclusions = 4;  ///< of a particle
constexpr std::int32_t kShortRow = 16;

std::int32_t rounded_up(std::int32_t n, std::int32_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

}  // namespace

/// The points of blocks near the cluster's box are put side by side and those near the box itself kept; of
/// these, for each list, first those within its own reach.
template <class Metric>
void RowFinder::append_rows(const Scene<Metric>& scene, std::int32_t k, NeighborList* lists) {
  const ClusterPoints& points = *scene.rows().points;
  const Cluster& cluster = points.clusters[k];
  const std::int32_t count = collect(scene, k);
  append_cluster(scene, scene.requests[0], cluster, around_cluster_.at(0), count, lists[0]);
  for (std::size_t r = 1; r < scene.requests.size(); ++r) {
    const Request& request = scene.requests[r];
    around_request_.make_room(around_cluster_.id.size());
    const std::int16_t size =
        points.tags.empty() ? std::int16_t{0}
                            : points.largest_tag(cluster.first_block, cluster.first_block + cluster.blocks);
    const std::int32_t near = filter(request.limits, cluster.span, size, around_cluster_.at(0), nullptr,
                                     count, around_request_.at(0));
    append_cluster(scene, request, cluster, around_request_.at(0), near, lists[r]);
  }
}

// --- points near a cluster

Candidates RowFinder::CandidateStore::at(std::int32_t k) {
  return {x.data() + k, y.data() + k, z.data() + k, id.data() + k, tag.data() + k};
}

void RowFinder::CandidateStore::make_room(std::size_t count) {
  if (id.size() >= count) return;
  for (auto* axis : {&x, &y, &z, &tag}) axis->resize(count);
  id.resize(count);
}

std::size_t RowFinder::CandidateStore::memory_bytes() const {
  return 4 * x.capacity() * sizeof(x[0]) + id.capacity() * sizeof(id[0]);
}

/// Fills around_cluster_ and returns how many there are. The cluster's own points come first, in order.
template <class Metric>
std::int32_t RowFinder::collect(const Scene<Metric>& scene, std::int32_t k) {
  const ClusterPoints& points = *scene.rows().points;
  const Cluster& cluster = points.clusters[k];
  const std::int16_t size =
      points.tags.empty() ? std::int16_t{0}
                          : points.largest_tag(cluster.first_block, cluster.first_block + cluster.blocks);
  std::int32_t count = 0;
  for (const NearSource& near : scene.near) {
    NearRanges<Metric> ranges(scene.metric, scene.box, scene.rows(), k, ranges_);
    if (&near == &scene.near.front()) {
      ranges.find_own(near);
    } else {
      ranges.find_others(near);
    }
    const std::int32_t collected = collect_from(near, cluster, count);
    count += filter(scene.requests[0].limits, cluster.span, size, around_cluster_.at(count), valid_.data(),
                    collected * kBlock, around_cluster_.at(count));
  }
  return count;
}

/// Puts the points of near blocks behind those that there are `already`, and returns the number of blocks. If
/// the cluster's points are all ghosts, blocks of ghosts are left out, since two ghosts are no pair.
std::int32_t RowFinder::collect_from(const NearSource& near, const Cluster& cluster, std::int32_t already) {
  const ClusterPoints& points = *near.source->points;
  std::int32_t most = 0;
  for (const BlockRange& range : ranges_) most += range.count;
  const auto blocks = static_cast<std::size_t>(rounded_up(most + 1, kBlocksInChunk)) + kBlocksInChunk;
  if (block_.size() < blocks) {
    block_.resize(blocks);
    range_.resize(blocks);
    valid_.resize(blocks / kBlocksInChunk);
  }
  around_cluster_.make_room(static_cast<std::size_t>(already) + blocks * kBlock);

  std::int32_t collected =
      kernels_->collect(cluster.box, near.box_limit, points.boxes.data(), ranges_.data(),
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
                   points.ids.data()->data(), points.tags.empty() ? nullptr : points.tags.data()->data(),
                   around_cluster_.at(already));
  auto* const lanes = reinterpret_cast<std::uint8_t*>(valid_.data());
  for (std::int32_t n = 0; n < collected; ++n)
    lanes[n] = static_cast<std::uint8_t>((1u << points.count[block_[n]]) - 1);
  return collected;
}

/// @param size the largest of the points in the box, where cutoffs go by radii
std::int32_t RowFinder::filter(const ListLimits& limits, const BlockSpan& span, std::int16_t size,
                               const Candidates& from, const std::uint32_t* valid, std::int32_t count,
                               const Candidates& to) const {
  if (limits.by == PairFilter::By::radii)
    return kernels_->filter_by_size(span, static_cast<std::int16_t>(size + limits.skin), limits.band, from,
                                    valid, count, to);
  if (limits.by == PairFilter::By::types && !limits.per_pair)
    return kernels_->filter_by_type(span, limits.farthest, from, valid, count, to);
  return kernels_->filter(span, limits.out, from, valid, count, to);
}

// --- rows

/// For each few of the cluster's blocks the candidates near these, and for each block those near it.
template <class Metric>
void RowFinder::append_cluster(const Scene<Metric>& scene, const Request& request, const Cluster& cluster,
                               const Candidates& around_cluster, std::int32_t count, NeighborList& out) {
  const ClusterPoints& points = *scene.rows().points;
  make_room_for_tests(count);
  const std::int32_t end = cluster.first_block + cluster.blocks;
  std::int32_t own_before = 0;
  for (std::int32_t first = cluster.first_block; first < end; first += kGroup) {
    const std::int32_t last = std::min(first + kGroup, end);
    const std::int16_t size = points.tags.empty() ? std::int16_t{0} : points.largest_tag(first, last);
    const Candidates from{around_cluster.x + own_before, around_cluster.y + own_before,
                          around_cluster.z + own_before, around_cluster.id + own_before,
                          around_cluster.tag + own_before};
    const std::int32_t near = filter(request.limits, points.span_of(first, last), size, from, nullptr,
                                     count - own_before, around_group_.at(0));
    std::int32_t before = 0;
    open_.clear();
    for (std::int32_t own = first; own < last; ++own) {
      BlockTest& test = tests_[own - first];
      test_block(scene, request, own, before, near, test);
      note_open_pairs(scene, request, own, cluster.owned, test);
      if (cluster.owned) before += points.count[own];
    }
    settle(scene, request);
    ask_for_exclusions(*request.filter, points, first, last);
    for (std::int32_t own = first; own < last; ++own)
      append_block(request, points, own, cluster.owned, tests_[own - first], out);
    own_before += before;
  }
}

void RowFinder::make_room_for_tests(std::int32_t count) {
  const std::size_t room = static_cast<std::size_t>(rounded_up(count, kChunk)) + 2 * kChunk;
  const std::size_t entries = room / kChunk * kBlock;
  around_group_.make_room(room);
  around_block_.make_room(room);
  if (unsettled_.size() >= entries) return;
  unsettled_.resize(entries);
  for (BlockTest& test : tests_) {
    test.ids.resize(room);
    test.mask.resize(entries);
  }
}

/// Tests a block against the candidates around its group from `begin` on that are near it.
template <class Metric>
void RowFinder::test_block(const Scene<Metric>& scene, const Request& request, std::int32_t block,
                           std::int32_t begin, std::int32_t end, BlockTest& test) {
  const ClusterPoints& points = *scene.rows().points;
  const ListLimits& limits = request.limits;
  const std::int16_t size = points.tags.empty() ? std::int16_t{0} : points.largest_tag(block, block + 1);
  Candidates candidates = around_block_.at(0);
  candidates.id = test.ids.data();
  const std::int32_t count =
      filter(limits, points.spans[block], size, around_group_.at(begin), nullptr, end - begin, candidates);
  test.chunks = rounded_up(count, kChunk) / kChunk;
  if (limits.by == PairFilter::By::radii) {
    std::array<std::int16_t, kBlock> sizes = points.tags[block];
    for (std::int16_t& row_size : sizes) row_size = static_cast<std::int16_t>(row_size + limits.skin);
    test.left = kernels_->test_by_size(points.points[block], sizes.data(), candidates, count, limits.band,
                                       test.mask.data(), test.chunks, unsettled_.data());
  } else if (limits.by == PairFilter::By::types && !limits.per_pair) {
    test.left = kernels_->test_by_type(points.points[block], points.tags[block].data(), candidates, count,
                                       limits.type_in.data(), limits.type_out.data(), test.mask.data(),
                                       test.chunks, unsettled_.data());
  } else {
    test.left = kernels_->test(points.points[block], candidates, count, limits.in, limits.out,
                               test.mask.data(), test.chunks, unsettled_.data());
  }
}

/// Puts the pairs that the test of a block has left open into open_. The first candidates are the block's own
/// points if it `meets_itself`.
template <class Metric>
void RowFinder::note_open_pairs(const Scene<Metric>& scene, const Request& request, std::int32_t block,
                                bool meets_itself, BlockTest& test) {
  const ListSource& source = scene.rows();
  const ClusterPoints& points = *source.points;
  const bool accept_all = request.filter->params().superset || request.limits.per_pair;
  for (std::int32_t u = 0; u < test.left; ++u) {
    const auto [row, chunk, open] = unsettled_[u];
    std::uint32_t& mask = test.mask[row * test.chunks + chunk];
    if (accept_all) mask |= open;
    if (accept_all || row >= points.count[block]) continue;
    for (std::uint32_t rest = open; rest != 0; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      if (meets_itself && chunk == 0 && lane <= row) continue;
      OpenPair pair{points.ids[block][row], test.ids[chunk * kChunk + lane], kNone, kNone, &mask, 1u << lane};
      if (source.particle_of_id.empty()) {
        pair.slot_i = points.source[block] * kBlock + row;
        pair.slot_j = source.slot_of_id[pair.j];
        __builtin_prefetch(&source.blocks->position[pair.slot_j]);
      } else {
        request.filter->ask_for(pair.i, pair.j);
      }
      open_.push_back(pair);
    }
  }
}

/// Decides the open pairs. Their positions are likely in no cache; they have been asked for together.
template <class Metric>
void RowFinder::settle(const Scene<Metric>& scene, const Request& request) {
  const std::vector<Vec3>& position = scene.rows().blocks->position;
  for (const OpenPair& pair : open_) {
    const bool accepted =
        pair.slot_i == kNone
            ? request.filter->accept(pair.i, pair.j)
            : request.filter->accept(pair.i, pair.j,
                                     scene.metric.distance2(position[pair.slot_i], position[pair.slot_j]));
    if (accepted) *pair.mask |= pair.bit;
  }
}

/// Whom the points of blocks [first, last) are excluded with is likely in no cache: asked for together.
void RowFinder::ask_for_exclusions(const PairFilter& filter, const ClusterPoints& points, std::int32_t first,
                                   std::int32_t last) {
  if (filter.params().exclusions == nullptr) return;
  for (std::int32_t block = first; block < last; ++block)
    for (std::int32_t row = 0; row < points.count[block]; ++row)
      __builtin_prefetch(filter.excluded_with(points.ids[block][row]).data());
}

/// The rows of one block's points.
void RowFinder::append_block(const Request& request, const ClusterPoints& points, std::int32_t block,
                             bool meets_itself, BlockTest& test, NeighborList& out) {
  const std::int32_t rows = points.count[block];
  const std::array<std::int32_t, kBlock>& ids = points.ids[block];
  auto written = static_cast<std::size_t>(out.first.back());
  const std::size_t most = written + static_cast<std::size_t>(kBlock * kChunk * test.chunks + kChunk);
  if (out.j.size() < most) out.j.resize(most + most / 4);
  for (std::int32_t row = 0; row < rows; ++row) {
    std::uint32_t* const mask = test.mask.data() + row * test.chunks;
    if (meets_itself) mask[0] &= ~0u << (row + 1);
    std::int32_t* const to = out.j.data() + written;
    std::int32_t length = kernels_->compress(mask, test.chunks, test.ids.data(), to);
    if (request.limits.per_pair || request.filter->restricts(ids[row]))
      length = restrict_row(request, ids[row], to, length);
    written += static_cast<std::size_t>(length);
    out.particle.push_back(ids[row]);
    out.first.push_back(static_cast<std::int64_t>(written));
  }
}

/// Exclusions and ghosts, and cutoffs where the kernels did not know them. Returns how many are left.
std::int32_t RowFinder::restrict_row(const Request& request, std::int32_t particle, std::int32_t* row,
                                     std::int32_t count) {
  const PairFilter& filter = *request.filter;
  const auto keep_if = [&](const auto& is_kept) {
    return static_cast<std::int32_t>(std::copy_if(row, row + count, row, is_kept) - row);
  };
  if (request.limits.per_pair) return keep_if([&](std::int32_t j) { return filter.accept(particle, j); });
  const Span<const std::int32_t> excluded = filter.excluded_with(particle);
  if (excluded.size() <= kFewExclusions && count <= kShortRow) {
    std::int32_t others[kFewExclusions] = {kNone, kNone, kNone, kNone};
    std::copy(excluded.begin(), excluded.end(), others);
    std::int32_t kept = 0;
    for (std::int32_t k = 0; k < count; ++k) {  // without branches: which are excluded is hard to foretell
      const std::int32_t j = row[k];
      row[kept] = j;
      kept += static_cast<std::int32_t>(j != others[0]) & static_cast<std::int32_t>(j != others[1]) &
              static_cast<std::int32_t>(j != others[2]) & static_cast<std::int32_t>(j != others[3]);
    }
    count = kept;
  } else if (excluded.size() <= static_cast<std::size_t>(count)) {
    for (const std::int32_t other : excluded) {
      std::int32_t found = 0;
      for (std::int32_t k = 0; k < count; ++k) found += row[k] == other;  // compilers make vectors of this
      if (found != 0) count = static_cast<std::int32_t>(std::remove(row, row + count, other) - row);
    }
  } else {
    count = keep_if([&](std::int32_t j) { return !std::binary_search(excluded.begin(), excluded.end(), j); });
  }
  if (filter.is_ghost(particle)) count = keep_if([&](std::int32_t j) { return !filter.is_ghost(j); });
  return count;
}

std::size_t RowFinder::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t bytes = bytes_of(ranges_) + bytes_of(block_) + bytes_of(range_) + bytes_of(valid_) +
                      bytes_of(open_) + bytes_of(unsettled_);
  for (const CandidateStore* store : {&around_cluster_, &around_request_, &around_group_, &around_block_})
    bytes += store->memory_bytes();
  for (const BlockTest& test : tests_) bytes += bytes_of(test.ids) + bytes_of(test.mask);
  return bytes;
}

#define DCH_INSTANTIATE(Metric) \
  template void RowFinder::append_rows(const Scene<Metric>&, std::int32_t, NeighborList*);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
