// SPDX-License-Identifier: MIT
#include "lists/row_finder.hpp"

#include <algorithm>

namespace dch::detail {
namespace {

constexpr std::size_t kFewExclusions = 32;  ///< of a particle: fewer than a search of them would cost
constexpr std::int32_t kGroup = 5;          ///< most blocks in one

}  // namespace

void RowFinder::append_rows(const std::vector<RowRequest>& requests, const OwnBlocks& own,
                            const Candidates& around, std::int32_t count, NeighborList* lists) {
  append_list(requests[0], own, around, count, lists[0]);
  if (requests.size() == 1) return;
  const BlockSpan span = own.span_of(0, own.blocks);
  const std::int16_t size = own.largest_tag(0, own.blocks);
  around_request_.make_room(static_cast<std::size_t>(count) + kChunk);
  for (std::size_t r = 1; r < requests.size(); ++r) {
    const std::int32_t near =
        keep_near(*kernels_, requests[r].limits, span, size, around, nullptr, count, around_request_.at(0));
    append_list(requests[r], own, around_request_.at(0), near, lists[r]);
  }
}

/// For each few blocks the candidates near these, which all are if there are no other blocks.
void RowFinder::append_list(const RowRequest& request, const OwnBlocks& own, const Candidates& around,
                            std::int32_t count, NeighborList& out) {
  if (own.blocks <= kGroup) return append_group(request, own, 0, own.blocks, around, count, out);
  around_group_.make_room(static_cast<std::size_t>(count) + kChunk);
  std::int32_t own_before = 0;
  for_each_group(0, own.blocks, kGroup, [&](std::int32_t first, std::int32_t last) {
    const Candidates from{around.x + own_before, around.y + own_before, around.z + own_before,
                          around.id + own_before, around.tag + own_before};
    const std::int32_t near =
        keep_near(*kernels_, request.limits, own.span_of(first, last), own.largest_tag(first, last), from,
                  nullptr, count - own_before, around_group_.at(0));
    append_group(request, own, first, last, around_group_.at(0), near, out);
    if (!own.are_candidates) return;
    for (std::int32_t block = first; block < last; ++block) own_before += own.count[block];
  });
}

/// For each block of a group the candidates near it, tested.
void RowFinder::append_group(const RowRequest& request, const OwnBlocks& own, std::int32_t first,
                             std::int32_t last, const Candidates& around, std::int32_t count,
                             NeighborList& out) {
  make_room_for_tests(count);
  // All blocks are thinned before the first is tested: its candidates have left the store queue by then,
  // out of which loads that span several stores cannot be served.
  std::int32_t before = 0;
  for (std::int32_t block = first; block < last; ++block) {
    BlockTest& test = tests_[block - first];
    const Candidates from{around.x + before, around.y + before, around.z + before, around.id + before,
                          around.tag + before};
    test.count = keep_near(*kernels_, request.limits, own.spans[block], own.largest_tag(block, block + 1),
                           from, nullptr, count - before, test.near.at(0));
    if (own.are_candidates) before += own.count[block];
  }
  open_.clear();  // there may be some of a list that was not finished
  for (std::int32_t block = first; block < last; ++block) {
    test_block(request, own, block, tests_[block - first]);
    open_.note(request, own, block, unsettled_.data(), tests_[block - first]);
  }
  open_.settle(*request.filter);
  ask_for_exclusions(*request.filter, own, first, last);
  for (std::int32_t block = first; block < last; ++block)
    append_block(request, own, block, tests_[block - first], out);
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
void RowFinder::test_block(const RowRequest& request, const OwnBlocks& own, std::int32_t block,
                           BlockTest& test) {
  test.chunks = rounded_up(test.count, kChunk) / kChunk;
  tested_ += std::int64_t{kBlock} * test.count;
  // First, since unsettled_ has to be left as the other test leaves it.
  if (request.limits.has_shell)
    test_against(request.limits, request.limits.near, own, block, test, test.near_mask.data());
  test.left = test_against(request.limits, request.limits.all, own, block, test, test.mask.data());
}

std::int32_t RowFinder::test_against(const ListLimits& limits, const PairLimits& pairs, const OwnBlocks& own,
                                     std::int32_t block, BlockTest& test, std::uint32_t* mask) {
  const Candidates candidates = test.near.at(0);
  if (limits.by == CutoffBy::radii) {
    OfLanes<std::int16_t> sizes = own.tags[block];
    for (std::int16_t& row_size : sizes) row_size = static_cast<std::int16_t>(row_size + pairs.skin);
    return kernels_->test_by_size(own.points[block], sizes.data(), candidates, test.count, pairs.band, mask,
                                  test.chunks, unsettled_.data());
  }
  if (limits.by == CutoffBy::types && !limits.per_pair)
    return kernels_->test_by_type(own.points[block], own.tags[block].data(), candidates, test.count,
                                  pairs.type_in.data(), pairs.type_out.data(), mask, test.chunks,
                                  unsettled_.data());
  return kernels_->test(own.points[block], candidates, test.count, pairs.in, pairs.out, mask, test.chunks,
                        unsettled_.data());
}

/// Whom the points of blocks [first, last) are excluded with is likely in no cache: asked for together.
void RowFinder::ask_for_exclusions(const PairFilter& filter, const OwnBlocks& own, std::int32_t first,
                                   std::int32_t last) {
  if (filter.params().exclusions == nullptr) return;
  for (std::int32_t block = first; block < last; ++block)
    for (std::int32_t row = 0; row < own.count[block]; ++row)
      __builtin_prefetch(filter.excluded_with(own.particle[block][row]).data());
}

/// The rows of one block's points.
void RowFinder::append_block(const RowRequest& request, const OwnBlocks& own, std::int32_t block,
                             BlockTest& test, NeighborList& out) {
  const std::int32_t rows = own.count[block];
  const OfLanes<std::int32_t>& ids = own.particle[block];
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
    if (own.are_candidates) mask[0] &= ~0u << (row + 1);
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
std::size_t RowFinder::append_some(const RowRequest& request, std::int32_t particle,
                                   const std::uint32_t* mask, BlockTest& test, std::int32_t* to) const {
  std::int32_t length = kernels_->compress(mask, test.chunks, test.near.at(0).id, to);
  if (request.limits.per_pair || request.filter->restricts(particle))
    length = restrict_row(request, particle, to, length);
  return static_cast<std::size_t>(length);
}

/// Exclusions and ghosts, and cutoffs where the kernels did not know them. Returns how many are left.
std::int32_t RowFinder::restrict_row(const RowRequest& request, std::int32_t particle, std::int32_t* row,
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
  std::size_t bytes = open_.memory_bytes() + bytes_of(unsettled_) + around_request_.memory_bytes() +
                      around_group_.memory_bytes();
  for (const BlockTest& test : tests_)
    bytes += test.near.memory_bytes() + bytes_of(test.mask) + bytes_of(test.near_mask);
  return bytes;
}

}  // namespace dch::detail
