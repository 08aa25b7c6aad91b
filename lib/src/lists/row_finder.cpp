// SPDX-License-Identifier: MIT
#include "lists/row_finder.hpp"

#include <algorithm>

#include "base/resize.hpp"

namespace dch::detail {
namespace {

constexpr std::size_t kFewExclusions = 32;  ///< of a particle: fewer than a search of them would cost
constexpr std::int32_t kGroup = 5;          ///< most blocks in one
constexpr std::int32_t kNobody = -1;
constexpr std::size_t kRoom = 2 * kChunk;  ///< that a row is overwritten beyond its end

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

/// For each block of a group the candidates near it, and their rows.
void RowFinder::append_group(const RowRequest& request, const OwnBlocks& own, std::int32_t first,
                             std::int32_t last, const Candidates& around, std::int32_t count,
                             NeighborList& out) {
  make_room(count);
  ask_for_exclusions(*request.filter, own, first, last);
  // All blocks are thinned before the rows of the first are found: its candidates have left the store queue
  // by then, out of which loads that span several stores cannot be served.
  std::int32_t before = 0;
  std::size_t most = kChunk;
  for (std::int32_t block = first; block < last; ++block) {
    BlockNear& near = near_[block - first];
    const Candidates from{around.x + before, around.y + before, around.z + before, around.id + before,
                          around.tag + before};
    near.count = keep_near(*kernels_, request.limits, own.spans[block], own.largest_tag(block, block + 1),
                           from, nullptr, count - before, near.candidates.at(0));
    tested_ += std::int64_t{kBlock} * near.count;
    most += std::size_t{kBlock} * static_cast<std::size_t>(near.count);
    if (own.are_candidates) before += own.count[block];
  }
  const auto written = static_cast<std::size_t>(out.first.back());
  make_room_for(out.j, written + most + kRoom, written, progress_);  // the largest part of all memory
  const bool is_ready = note_exclusions(*request.filter, own, first, last);
  const bool is_restricted = request.limits.per_pair || !is_ready;
  if (is_restricted && as_written_.size() < most) as_written_.resize(most);
  std::int32_t* const to = is_restricted ? as_written_.data() : out.j.data() + written;
  write_group(request, own, first, last, to);
  const std::vector<RowEdit>& edits = open_.decide(*request.filter);
  if (is_restricted) {
    finish_rows(request, own, first, edits, out);
  } else {
    apply_edits(edits, to, {segment_end_.data(), static_cast<std::size_t>(segments_) + 1});
  }
  append_ends(request, own, first, last, out);
}

void RowFinder::make_room(std::int32_t count) {
  near_.resize(kGroup);
  const std::size_t room = static_cast<std::size_t>(rounded_up(count, kChunk)) + 2 * kChunk;
  const std::size_t entries = room / kChunk * 2 * kBlock;
  segment_end_.resize(std::size_t{2} * kGroup * kBlock + 1);
  if (room_ >= entries) return;
  open_lanes_.resize(entries);
  for (BlockNear& near : near_) near.candidates.make_room(room);
  room_ = entries;
}

/// Writes the rows of a group as the kernels find them, and notes where each segment ends and what they leave
/// open.
void RowFinder::write_group(
    const RowRequest& request, const OwnBlocks& own, std::int32_t first, std::int32_t last,
    std::int32_t* to) {  // NOLINT(readability-non-const-parameter): kernels write there
  const ListLimits& limits = request.limits;
  const bool take_open = request.filter->params().superset || limits.per_pair;
  RowLimits all = limits.for_rows(limits.all, take_open);
  RowLimits near = limits.for_rows(limits.near, true);
  const auto kernel = limits.by == CutoffBy::radii                       ? kernels_->rows_by_size
                      : limits.by == CutoffBy::types && !limits.per_pair ? kernels_->rows_by_type
                                                                         : kernels_->rows;
  open_.clear();  // there may be some of a list that was not finished
  segments_ = 0;
  segment_end_[0] = 0;
  for (std::int32_t block = first; block < last; ++block) {
    BlockNear& others = near_[block - first];
    all.rows = near.rows = own.tags == nullptr ? nullptr : own.tags[block].data();
    const std::int32_t written = segment_end_[segments_];
    std::int32_t* const end = segment_end_.data() + segments_ + 1;
    const RowsTo target{to + written, end, open_lanes_.data(), own.are_candidates,
                        excluded_.empty() ? nullptr : &excluded_[kFewExcluded * kBlock * (block - first)]};
    const Candidates candidates = others.candidates.at(0);
    const std::int32_t open = kernel(own.points[block], own.count[block], candidates, others.count, all,
                                     limits.has_shell ? &near : nullptr, target);
    const std::int32_t segments = own.count[block] * (limits.has_shell ? 2 : 1);
    for (std::int32_t s = 0; s < segments; ++s) end[s] += written;
    open_.note(request, own, block, segments_, candidates, open_lanes_.data(), open);
    segments_ += segments;
  }
}

/// Whom the points of blocks [first, last) are excluded with is likely in no cache: asked for together.
void RowFinder::ask_for_exclusions(const PairFilter& filter, const OwnBlocks& own, std::int32_t first,
                                   std::int32_t last) {
  if (filter.params().exclusions == nullptr) return;
  for (std::int32_t block = first; block < last; ++block)
    for (std::int32_t row = 0; row < own.count[block]; ++row)
      __builtin_prefetch(filter.excluded_with(own.particle[block][row]).data());
}

/// Notes what the kernels are to leave out of the rows of blocks [first, last). Returns whether that is all
/// that exclusions and ghosts keep out of them; else nothing is noted.
bool RowFinder::note_exclusions(const PairFilter& filter, const OwnBlocks& own, std::int32_t first,
                                std::int32_t last) {
  excluded_.clear();
  if (!filter.restricts_any()) return true;
  excluded_.resize(std::size_t{kFewExcluded} * kBlock * static_cast<std::size_t>(last - first), kNobody);
  std::int32_t* to = excluded_.data();
  bool any = false;
  for (std::int32_t block = first; block < last; ++block, to += kFewExcluded * kBlock)
    for (std::int32_t row = 0; row < own.count[block]; ++row) {
      const std::int32_t particle = own.particle[block][row];
      const Span<const std::int32_t> excluded = filter.excluded_with(particle);
      if (excluded.size() > kFewExcluded || filter.is_ghost(particle)) {
        excluded_.clear();
        return false;
      }
      for (std::size_t k = 0; k < excluded.size(); ++k)
        to[kFewExcluded * row + static_cast<int>(k)] = excluded[k];
      any |= !excluded.empty();
    }
  if (!any) excluded_.clear();
  return true;
}

/// Copies the segments of a group as they are to be: from as_written_ to behind the rows of the groups
/// before.
void RowFinder::finish_rows(const RowRequest& request, const OwnBlocks& own, std::int32_t block,
                            const std::vector<RowEdit>& edits, NeighborList& out) {
  std::int32_t* const to = out.j.data() + out.first.back();
  const RowEdit* edit = edits.data();
  const RowEdit* const end = edit + edits.size();
  const int parts = request.limits.has_shell ? 2 : 1;
  std::int32_t row = 0;  // of the blocks from `block` on
  std::int32_t begin = 0, written = 0;
  for (std::int32_t s = 0; s < segments_; ++s) {
    for (; row >= own.count[block]; ++block) row -= own.count[block];
    const std::int32_t length = segment_end_[s + 1] - begin;
    const RowEdit* const first = edit;
    while (edit != end && edit->segment == s) ++edit;
    written += finish_segment(request, own.particle[block][row], as_written_.data() + begin, length,
                              {first, static_cast<std::size_t>(edit - first)}, to + written);
    begin += length;
    segment_end_[s + 1] = written;
    row += static_cast<std::int32_t>((s + 1) % parts == 0);
  }
}

/// Returns the length of the segment.
std::int32_t RowFinder::finish_segment(const RowRequest& request, std::int32_t particle,
                                       const std::int32_t* from, std::int32_t length,
                                       Span<const RowEdit> edits, std::int32_t* to) const {
  std::int32_t taken = 0, written = 0;
  const auto copy_until = [&](std::int32_t place) {
    std::copy(from + taken, from + place, to + written);
    written += place - taken;
    taken = place;
  };
  for (const RowEdit& edit : edits) {
    copy_until(edit.place);
    if (edit.is_missing) {
      to[written++] = edit.id;
    } else {
      ++taken;
    }
  }
  const bool is_restricted = request.limits.per_pair || request.filter->restricts(particle);
  if (is_restricted && edits.empty()) return restricted_row(request, particle, from, length, to);
  copy_until(length);
  return is_restricted ? restricted_row(request, particle, to, written, to) : written;
}

/// Where the rows of a finished group end, and whose they are.
void RowFinder::append_ends(const RowRequest& request, const OwnBlocks& own, std::int32_t first,
                            std::int32_t last, NeighborList& out) const {
  const std::int64_t begin = out.first.back();
  for (std::int32_t block = first; block < last; ++block)
    out.particle.insert(out.particle.end(), own.particle[block].begin(),
                        own.particle[block].begin() + own.count[block]);
  const int parts = request.limits.has_shell ? 2 : 1;
  const std::size_t rows = out.first.size();
  out.first.resize(out.particle.size() + 1);
  const std::int32_t* end = segment_end_.data() + parts;
  for (std::size_t row = rows; row < out.first.size(); ++row, end += parts) {
    if (parts == 2) out.near_end.push_back(begin + end[-1]);
    out.first[row] = begin + *end;
  }
}

/// Copies a row without what exclusions and ghosts keep out of it, and cutoffs where the kernels did not know
/// them. Returns how many are left.
std::int32_t RowFinder::restricted_row(const RowRequest& request, std::int32_t particle,
                                       const std::int32_t* row, std::int32_t count, std::int32_t* to) const {
  const PairFilter& filter = *request.filter;
  const auto keep_if = [&](const std::int32_t* from, const auto& is_kept) {
    return static_cast<std::int32_t>(std::copy_if(from, from + count, to, is_kept) - to);
  };
  if (request.limits.per_pair)
    return keep_if(row, [&](std::int32_t j) { return filter.accept(particle, j); });
  const Span<const std::int32_t> excluded = filter.excluded_with(particle);
  if (excluded.size() <= kFewExclusions) {
    count = kernels_->leave_out(row, count, excluded.data(), static_cast<std::int32_t>(excluded.size()), to);
  } else {
    count = keep_if(row,
                    [&](std::int32_t j) { return !std::binary_search(excluded.begin(), excluded.end(), j); });
  }
  if (filter.is_ghost(particle)) count = keep_if(to, [&](std::int32_t j) { return !filter.is_ghost(j); });
  return count;
}

std::size_t RowFinder::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t bytes = open_.memory_bytes() + bytes_of(open_lanes_) + bytes_of(as_written_) +
                      bytes_of(segment_end_) + bytes_of(excluded_) + around_request_.memory_bytes() +
                      around_group_.memory_bytes();
  for (const BlockNear& near : near_) bytes += near.candidates.memory_bytes();
  return bytes;
}

}  // namespace dch::detail
