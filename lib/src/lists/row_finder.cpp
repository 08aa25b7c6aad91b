// SPDX-License-Identifier: MIT
#include "lists/row_finder.hpp"

#include <algorithm>

#include <dch/base/index_count.hpp>

#include "geometry/metric.hpp"

namespace dch::detail {
namespace {

constexpr std::size_t kFewExclusions = 32;      ///< of a particle: fewer than a search of them would cost
constexpr std::int32_t kPart = 24, kGroup = 5;  ///< most blocks in one

/// Calls f(first, last) for groups of at most that many blocks, so cut that those of one group are close
/// together: where order_by_halving() has cut.
template <class F>
void for_each_group(std::int32_t first, std::int32_t blocks, std::int32_t most, const F& f) {
  if (blocks <= most) {
    if (blocks > 0) f(first, first + blocks);
    return;
  }
  for_each_group(first, blocks / 2, most, f);
  for_each_group(first + blocks / 2, blocks - blocks / 2, most, f);
}

std::int32_t rounded_up(std::int32_t n, std::int32_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

}  // namespace

/// The points of blocks near the box of a part of the leaf are put side by side and those near the box
/// itself kept; of these, for each list, first those within its own reach.
template <class Metric>
void RowFinder::append_rows(const Scene<Metric>& scene, std::int32_t k, NeighborList* lists) {
  const LeafSource& leaves = scene.rows();
  const Leaf& leaf = leaves.measured().leaves[k];
  find_ranges(scene, k);
  for_each_group(leaf.first_block, leaf.blocks, kPart, [&](std::int32_t first, std::int32_t last) {
    const Part part = part_of(leaves, k, first, last);
    const std::int32_t count = collect(scene, part);
    append_part(scene, scene.requests[0], part, around_part_.at(0), count, lists[0]);
    for (std::size_t r = 1; r < scene.requests.size(); ++r) {
      const Request& request = scene.requests[r];
      around_request_.make_room(around_part_.id.size());
      const std::int32_t near = filter(request.limits, part.span, part.size, around_part_.at(0), nullptr,
                                       count, around_request_.at(0));
      append_part(scene, request, part, around_request_.at(0), near, lists[r]);
    }
  });
}

// --- points near a leaf

Candidates RowFinder::CandidateStore::at(std::int32_t k) {
  return {x.data() + k, y.data() + k, z.data() + k, id.data() + k, tag.data() + k};
}

void RowFinder::CandidateStore::make_room(std::size_t count) {
  if (id.size() >= count) return;
  count += count / 8;
  for (auto* axis : {&x, &y, &z, &tag}) {
    axis->reserve(count);  // else it might take twice as much
    axis->resize(count);
  }
  id.reserve(count);
  id.resize(count);
}

std::size_t RowFinder::CandidateStore::memory_bytes() const {
  return 4 * x.capacity() * sizeof(x[0]) + id.capacity() * sizeof(id[0]);
}

RowFinder::Part RowFinder::part_of(const LeafSource& leaves, std::int32_t k, std::int32_t first,
                                   std::int32_t last) {
  return {first, last, leaves.labelled.leaf_owned[k] != 0, leaves.largest_tag(first, last),
          leaves.quantized.span_of(first, last)};
}

/// Fills ranges_.
template <class Metric>
void RowFinder::find_ranges(const Scene<Metric>& scene, std::int32_t k) {
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

/// Fills around_part_ and returns how many there are. The part's own points come first, in order, then those
/// of the leaf's parts after it.
template <class Metric>
std::int32_t RowFinder::collect(const Scene<Metric>& scene, const Part& part) {
  const BlockSpan box = scene.rows().quantized.box_of(part.first, part.last);
  BlockRange& own = ranges_[0][0];
  own.count -= part.first - own.first;
  own.first = part.first;
  std::int32_t count = 0;
  for (std::size_t s = 0; s < scene.near.size(); ++s) {
    const std::int32_t collected = collect_from(scene.near[s], ranges_[s], box, part.owned, count);
    work_.gathered += std::int64_t{kBlock} * collected;
    count += filter(scene.requests[0].limits, part.span, part.size, around_part_.at(count), valid_.data(),
                    collected * kBlock, around_part_.at(count));
  }
  return count;
}

/// Puts the points of blocks near the box behind those that there are `already`, and returns the number of
/// blocks. If the leaf's points are all ghosts, blocks of ghosts are left out, since two ghosts are no
/// pair.
std::int32_t RowFinder::collect_from(const NearSource& near, const std::vector<BlockRange>& ranges,
                                     const BlockSpan& box, bool owned, std::int32_t already) {
  const LeafSource& leaves = *near.source;
  std::int64_t lanes_near = already;
  for (const BlockRange& range : ranges) lanes_near += std::int64_t{kBlock} * range.count;
  index_count(lanes_near, "points and images of points near one cluster", "take a smaller cutoff",
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
  around_part_.make_room(static_cast<std::size_t>(already) + static_cast<std::size_t>(collected) * kBlock +
                         kChunk);
  kernels_->gather(block_.data(), range_end_.data(), ranges.data(), range_count,
                   leaves.quantized.points.data(), leaves.labelled.particle.data()->data(),
                   leaves.tags() == nullptr ? nullptr : leaves.tags()->data(), around_part_.at(already));
  auto* const lanes = reinterpret_cast<std::uint8_t*>(valid_.data());
  for (std::int32_t n = 0; n < collected; ++n) lanes[n] = leaves.measured().lanes[block_[n]];
  return collected;
}

/// Of the blocks that have been collected.
std::int32_t RowFinder::leave_out_ghosts(const LeafSource& leaves, std::int32_t range_count) {
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

/// @param size the largest of the points in the box, where cutoffs go by radii
std::int32_t RowFinder::filter(const ListLimits& limits, const BlockSpan& span, std::int16_t size,
                               const Candidates& from, const std::uint32_t* valid, std::int32_t count,
                               const Candidates& to) const {
  if (limits.by == CutoffBy::radii)
    return kernels_->filter_by_size(span, static_cast<std::int16_t>(size + limits.all.skin), limits.all.band,
                                    from, valid, count, to);
  if (limits.by == CutoffBy::types && !limits.per_pair)
    return kernels_->filter_by_type(span, limits.farthest, from, valid, count, to);
  return kernels_->filter(span, limits.all.out, from, valid, count, to);
}

// --- rows

/// For each few of the part's blocks the candidates near these, and for each block those near it.
template <class Metric>
void RowFinder::append_part(const Scene<Metric>& scene, const Request& request, const Part& part,
                            const Candidates& around_part, std::int32_t count, NeighborList& out) {
  const LeafSource& leaves = scene.rows();
  around_group_.make_room(static_cast<std::size_t>(count) + kChunk);
  std::int32_t own_before = 0;
  for_each_group(part.first, part.last - part.first, kGroup, [&](std::int32_t first, std::int32_t last) {
    const std::int16_t size = leaves.largest_tag(first, last);
    const Candidates from{around_part.x + own_before, around_part.y + own_before, around_part.z + own_before,
                          around_part.id + own_before, around_part.tag + own_before};
    const std::int32_t near = filter(request.limits, leaves.quantized.span_of(first, last), size, from,
                                     nullptr, count - own_before, around_group_.at(0));
    make_room_for_tests(near);
    // All blocks are thinned before the first is tested: its candidates have left the store queue by then,
    // out of which loads that span several stores cannot be served.
    std::int32_t before = 0;
    for (std::int32_t own = first; own < last; ++own) {
      BlockTest& test = tests_[own - first];
      const std::int16_t own_size = leaves.largest_tag(own, own + 1);
      test.count = filter(request.limits, leaves.quantized.spans[own], own_size, around_group_.at(before),
                          nullptr, near - before, test.near.at(0));
      if (part.owned) before += leaves.measured().count[own];
    }
    open_count_ = 0;  // there may be some of a list that was not finished
    for (std::int32_t own = first; own < last; ++own) {
      test_block(request, leaves, own, tests_[own - first]);
      note_open_pairs(request, leaves, own, tests_[own - first]);
    }
    settle(*request.filter);
    ask_for_exclusions(*request.filter, leaves, first, last);
    for (std::int32_t own = first; own < last; ++own)
      append_block(request, leaves, own, part.owned, tests_[own - first], out);
    own_before += before;
  });
}

void RowFinder::make_room_for_tests(std::int32_t count) {
  tests_.resize(kGroup);
  const std::size_t room = static_cast<std::size_t>(rounded_up(count, kChunk)) + 2 * kChunk;
  const std::size_t entries = room / kChunk * std::size_t{kBlock};
  if (test_room_ >= entries) return;
  unsettled_.resize(entries);
  for (BlockTest& test : tests_) {
    test.near.make_room(room);
    test.mask.resize(entries);
    test.near_mask.resize(entries);
  }
  test_room_ = entries;
}

/// Tests a block against the candidates near it.
void RowFinder::test_block(const Request& request, const LeafSource& leaves, std::int32_t block,
                           BlockTest& test) {
  test.chunks = rounded_up(test.count, kChunk) / kChunk;
  work_.tested += std::int64_t{kBlock} * test.count;
  // First, since unsettled_ has to be left as the other test leaves it.
  if (request.limits.has_shell)
    test_against(request.limits, request.limits.near, leaves, block, test, test.near_mask.data());
  test.left = test_against(request.limits, request.limits.all, leaves, block, test, test.mask.data());
}

std::int32_t RowFinder::test_against(const ListLimits& limits, const PairLimits& pairs,
                                     const LeafSource& leaves, std::int32_t block, BlockTest& test,
                                     std::uint32_t* mask) {
  const Candidates candidates = test.near.at(0);
  if (limits.by == CutoffBy::radii) {
    std::array<std::int16_t, kBlock> sizes = leaves.tags()[block];
    for (std::int16_t& row_size : sizes) row_size = static_cast<std::int16_t>(row_size + pairs.skin);
    return kernels_->test_by_size(leaves.quantized.points[block], sizes.data(), candidates, test.count,
                                  pairs.band, mask, test.chunks, unsettled_.data());
  }
  if (limits.by == CutoffBy::types && !limits.per_pair)
    return kernels_->test_by_type(leaves.quantized.points[block], leaves.tags()[block].data(), candidates,
                                  test.count, pairs.type_in.data(), pairs.type_out.data(), mask, test.chunks,
                                  unsettled_.data());
  return kernels_->test(leaves.quantized.points[block], candidates, test.count, pairs.in, pairs.out, mask,
                        test.chunks, unsettled_.data());
}

/// In units, without the roundings of the kernels' squares.
double RowFinder::squared_distance(const BlockPoints& points, std::int32_t row, const CandidateStore& near,
                                   std::int32_t at) {
  const auto square = [](std::int16_t a, std::int16_t b) {
    const double d = static_cast<std::int16_t>(a - b);
    return d * d;
  };
  return square(near.x[at], points.x[row]) + square(near.y[at], points.y[row]) +
         square(near.z[at], points.z[row]);
}

/// Of a point of a block with one that has this tag [units].
double RowFinder::cutoff_of(const ListLimits& limits, const LeafSource& leaves, std::int32_t block,
                            std::int32_t row, std::int16_t tag) {
  switch (limits.by) {
    case CutoffBy::radii:
      return leaves.tags()[block][row] + tag + limits.all.skin;
    case CutoffBy::types:
      return limits.type_cutoff[leaves.tags()[block][row]][tag];
    default:
      return limits.cutoff;
  }
}

/// Decides what the test of a block has left open, or puts it into open_ if that takes the positions.
void RowFinder::note_open_pairs(const Request& request, const LeafSource& leaves, std::int32_t block,
                                BlockTest& test) {
  const ListLimits& limits = request.limits;
  if (request.filter->params().superset || limits.per_pair) {
    for (std::int32_t u = 0; u < test.left; ++u)
      test.mask[unsettled_[u].row * test.chunks + unsettled_[u].chunk] |= unsettled_[u].lanes;
    return;
  }
  for (std::int32_t u = 0; u < test.left; ++u) {
    const auto [row, chunk, open] = unsettled_[u];
    std::uint32_t& mask = test.mask[row * test.chunks + chunk];
    if (open_.size() < open_count_ + kChunk) open_.resize(2 * open_count_ + kChunk);
    for (std::uint32_t rest = row < leaves.measured().count[block] ? open : 0; rest != 0; rest &= rest - 1) {
      // Without branches: whether a pair is near enough is hard to foretell.
      const int lane = __builtin_ctz(rest);
      const std::int32_t at = chunk * kChunk + lane;
      const double d2 = squared_distance(leaves.quantized.points[block], row, test.near, at);
      const double cutoff = cutoff_of(limits, leaves, block, row, test.near.tag[at]);
      const double less = std::max(cutoff - limits.off, 0.0), more = cutoff + limits.off;
      const bool is_in = d2 < less * less;
      mask |= static_cast<std::uint32_t>(is_in) << lane;
      OpenPair& pair = open_[open_count_];
      pair = {leaves.labelled.particle[block][row], test.near.id[at], &mask, 1u << lane};
      request.filter->ask_for(pair.i, pair.j);
      open_count_ += static_cast<std::size_t>(!is_in) & static_cast<std::size_t>(d2 <= more * more);
    }
  }
}

/// Decides the open pairs. Their positions are likely in no cache; they have been asked for together.
void RowFinder::settle(const PairFilter& filter) {
  for (std::size_t k = 0; k < open_count_; ++k)
    if (filter.accept(open_[k].i, open_[k].j)) *open_[k].mask |= open_[k].bit;
}

/// Whom the points of blocks [first, last) are excluded with is likely in no cache: asked for together.
void RowFinder::ask_for_exclusions(const PairFilter& filter, const LeafSource& leaves, std::int32_t first,
                                   std::int32_t last) {
  if (filter.params().exclusions == nullptr) return;
  for (std::int32_t block = first; block < last; ++block)
    for (std::int32_t row = 0; row < leaves.measured().count[block]; ++row)
      __builtin_prefetch(filter.excluded_with(leaves.labelled.particle[block][row]).data());
}

/// The rows of one block's points.
void RowFinder::append_block(const Request& request, const LeafSource& leaves, std::int32_t block,
                             bool meets_itself, BlockTest& test, NeighborList& out) {
  const std::int32_t rows = leaves.measured().count[block];
  const std::array<std::int32_t, kBlock>& ids = leaves.labelled.particle[block];
  auto written = static_cast<std::size_t>(out.first.back());
  const std::size_t most =
      written + std::size_t{kBlock * kChunk} * static_cast<std::size_t>(test.chunks) + kChunk;
  if (out.j.size() < most) out.j.resize(most + most / 4);
  const std::size_t rows_before = out.particle.size();
  out.particle.insert(out.particle.end(), ids.begin(), ids.begin() + rows);
  out.first.resize(rows_before + static_cast<std::size_t>(rows) + 1);
  std::int64_t* const row_end = out.first.data() + rows_before + 1;
  for (std::int32_t row = 0; row < rows; ++row) {
    std::uint32_t* const mask = test.mask.data() + std::ptrdiff_t{row} * test.chunks;
    if (meets_itself) mask[0] &= ~0u << (row + 1);
    if (request.limits.has_shell) {
      std::uint32_t* const near = test.near_mask.data() + std::ptrdiff_t{row} * test.chunks;
      for (std::int32_t chunk = 0; chunk < test.chunks; ++chunk) {
        near[chunk] &= mask[chunk];
        mask[chunk] &= ~near[chunk];
      }
      written += append_some(request, ids[row], near, test, out.j.data() + written);
      out.near_end.push_back(static_cast<std::int64_t>(written));
    }
    written += append_some(request, ids[row], mask, test, out.j.data() + written);
    row_end[row] = static_cast<std::int64_t>(written);
  }
}

/// Returns how many.
std::size_t RowFinder::append_some(const Request& request, std::int32_t particle, const std::uint32_t* mask,
                                   const BlockTest& test, std::int32_t* to) const {
  std::int32_t length = kernels_->compress(mask, test.chunks, test.near.id.data(), to);
  if (request.limits.per_pair || request.filter->restricts(particle))
    length = restrict_row(request, particle, to, length);
  return static_cast<std::size_t>(length);
}

/// Exclusions and ghosts, and cutoffs where the kernels did not know them. Returns how many are left.
std::int32_t RowFinder::restrict_row(const Request& request, std::int32_t particle, std::int32_t* row,
                                     std::int32_t count) const {
  const PairFilter& filter = *request.filter;
  const auto keep_if = [&](const auto& is_kept) {
    return static_cast<std::int32_t>(std::copy_if(row, row + count, row, is_kept) - row);
  };
  if (request.limits.per_pair) return keep_if([&](std::int32_t j) { return filter.accept(particle, j); });
  const Span<const std::int32_t> excluded = filter.excluded_with(particle);
  if (excluded.size() <= kFewExclusions) {
    count = kernels_->leave_out(row, count, excluded.data(), static_cast<std::int32_t>(excluded.size()));
  } else {
    count = keep_if([&](std::int32_t j) { return !std::binary_search(excluded.begin(), excluded.end(), j); });
  }
  if (filter.is_ghost(particle)) count = keep_if([&](std::int32_t j) { return !filter.is_ghost(j); });
  return count;
}

std::size_t RowFinder::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t bytes =
      bytes_of(block_) + bytes_of(range_end_) + bytes_of(valid_) + bytes_of(open_) + bytes_of(unsettled_);
  for (const CandidateStore* store : {&around_part_, &around_request_, &around_group_})
    bytes += store->memory_bytes();
  for (const std::vector<BlockRange>& ranges : ranges_) bytes += bytes_of(ranges);
  for (const BlockTest& test : tests_)
    bytes += test.near.memory_bytes() + bytes_of(test.mask) + bytes_of(test.near_mask);
  return bytes;
}

#define DCH_INSTANTIATE(Metric) \
  template void RowFinder::append_rows(const Scene<Metric>&, std::int32_t, NeighborList*);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
