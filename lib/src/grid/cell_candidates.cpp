// SPDX-License-Identifier: MIT
#include "grid/cell_candidates.hpp"

#include <algorithm>
#include <cstring>

#include <dch/base/index_count.hpp>

#include "leaves/rounding.hpp"

namespace dch::detail {
namespace {

/// Numbers of the points of a block, in a register: compilers leave the loops over them as they are.
using Lanes __attribute__((vector_size(kBlock * sizeof(std::int16_t)))) = std::int16_t;
using WrappingLanes __attribute__((vector_size(kBlock * sizeof(std::uint16_t)))) = std::uint16_t;

/// The number that `choose` of two lanes prefers to all others.
template <class Choose>
std::int16_t chosen_of(Lanes v, const Choose& choose) {
  static_assert(kBlock == 8);
  v = choose(v, __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3));
  v = choose(v, __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5));
  v = choose(v, __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6));
  return v[0];
}

/// Box around the points of a block, all lanes of which hold one. Coordinates wrap, so all is taken relative
/// to the first of them.
BlockSpan span_around(const BlockPoints& points) {
  BlockSpan span{};
  const std::int16_t* const axes[3] = {points.x, points.y, points.z};
  for (int axis = 0; axis < 3; ++axis) {
    WrappingLanes at;
    std::memcpy(&at, axes[axis], sizeof at);
    const std::uint16_t origin = at[0];
    const auto from_origin = reinterpret_cast<Lanes>(at - origin);
    const int low = chosen_of(from_origin, [](Lanes a, Lanes b) { return a < b ? a : b; });
    const int high = chosen_of(from_origin, [](Lanes a, Lanes b) { return a > b ? a : b; });
    const int middle = (low + high) >> 1;
    span.center[axis] =
        static_cast<std::int16_t>(static_cast<std::uint16_t>(origin + static_cast<std::uint16_t>(middle)));
    span.half_width[axis] = static_cast<std::int16_t>(std::max(high - middle, middle - low));
  }
  return span;
}

}  // namespace

OwnBlocks CellCandidates::take_blocks(const CellScene& scene, std::int32_t cell, CellLayer::Run part) {
  const Candidates from = scene.rows.at(part.begin);
  const std::int32_t blocks = rounded_up(part.size(), kBlock) / kBlock;
  for (std::int32_t b = 0; b < blocks; ++b) {
    const std::int32_t at = b * kBlock, count = std::min(kBlock, part.size() - at);
    std::copy_n(from.x + at, kBlock, points_[b].x);
    std::copy_n(from.y + at, kBlock, points_[b].y);
    std::copy_n(from.z + at, kBlock, points_[b].z);
    std::copy_n(from.id + at, kBlock, particle_[b].data());
    in_block_[b] = static_cast<std::uint8_t>(count);
    for (std::int32_t lane = count; lane < kBlock; ++lane) {
      points_[b].x[lane] = points_[b].x[0];
      points_[b].y[lane] = points_[b].y[0];
      points_[b].z[lane] = points_[b].z[0];
    }
    spans_[b] = span_around(points_[b]);
    if (from.tag == nullptr) continue;
    tags_[b].fill(0);
    std::copy_n(from.tag + at, count, tags_[b].data());
  }
  OwnBlocks own{points_.data(),   spans_.data(),
                particle_.data(), from.tag == nullptr ? nullptr : tags_.data(),
                in_block_.data(), blocks};
  own.wrap = true;
  own.are_candidates = !scene.has_ghosts || scene.rows.is_owned(cell);
  return own;
}

void CellCandidates::collect(const CellScene& scene, std::int32_t cell, const OwnBlocks& own,
                             CellLayer::Run part) {
  count_ = 0;
  span_ = own.span_of(0, own.blocks);
  size_ = own.largest_tag(0, own.blocks);
  only_owned_ = !own.are_candidates;
  const CellCoordinates c = scene.rows.coordinates(cell);
  // No point is left out of what is near the box around it. Cells of the same row that follow lie behind it.
  const StencilRow* first = scene.stencil.data();
  const StencilRow* const last = first + scene.stencil.size();
  if (own.are_candidates) {
    std::int32_t end = scene.rows.points_of(cell).end;
    if (first != last && first->y == 0 && first->z == 0 && scene.rows.are_in_row(cell, first->last)) {
      end = scene.rows.points_of(cell + first->last).end;
      ++work_.boxes;
      ++first;
    }
    append_run(scene, scene.rows, {part.begin, end}, {});
  }
  for (; first != last; ++first) {
    const StencilRow& row = *first;
    append_row(scene, scene.rows, c[1] + row.y, c[2] + row.z, c[0] + row.first, c[0] + row.last);
  }
  for (const CellScene::Near& near : scene.finer) collect_finer(scene, near, part);
}

/// Those near the box around the part's points.
void CellCandidates::collect_finer(const CellScene& scene, const CellScene::Near& near, CellLayer::Run part) {
  if (near.layer->size() == 0) return;
  const CellLayout& layout = near.layer->layout();
  const Candidates own = scene.rows.at(part.begin);
  const auto at = [&](std::int32_t k) {
    return layout.real_coordinates(scene.box.wrap(scene.positions[static_cast<std::size_t>(own.id[k])]));
  };
  Vec3 low = at(0), high = low;
  for (std::int32_t k = 1; k < part.size(); ++k) {
    const Vec3 u = at(k);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], u[axis]);
      high[axis] = std::max(high[axis], u[axis]);
    }
  }
  layout.for_each_row_near(low, high, near.reach,
                           [&](std::int32_t y, std::int32_t z, std::int32_t first, std::int32_t last) {
                             append_row(scene, *near.layer, y, z, first, last);
                           });
}

/// Cells first .. last of a row, which may go on beyond the period.
void CellCandidates::append_row(const CellScene& scene, CellLayer& layer, std::int32_t y, std::int32_t z,
                                std::int32_t first, std::int32_t last) {
  ++work_.boxes;
  const CellLayout& layout = layer.layout();
  Vec3 by;
  bool is_here = true;
  for (const std::size_t k : {2u, 1u}) {
    std::int32_t& c = k == 2 ? z : y;
    if (layout[k].cells == 0 || (c >= 0 && c < layout[k].cells)) continue;
    by = by + static_cast<double>(wrap(c, layout[k].cells)) * layout[k].period;
    is_here = false;
  }
  const auto append = [&](std::int32_t from, std::int32_t to, const Shift& shift) {
    layer.for_each_run(from, to, y, z, only_owned_,
                       [&](CellLayer::Run run) { append_run(scene, layer, run, shift); });
  };
  const std::int32_t cells = layout[0].cells;
  if (cells == 0 || (first >= 0 && last < cells))
    return append(first, last, is_here ? Shift() : shift_of(scene, by));
  while (first <= last) {
    std::int32_t begin = first;
    const std::int32_t periods = wrap(begin, cells), end = std::min(cells - 1, begin + (last - first));
    const bool needs_none = is_here && periods == 0;
    append(begin, end,
           needs_none ? Shift() : shift_of(scene, by + static_cast<double>(periods) * layout[0].period));
    first += end - begin + 1;
  }
}

CellCandidates::Shift CellCandidates::shift_of(const CellScene& scene, Vec3 by) {
  const double per_unit = scene.per_unit;
  Shift shift{false, {rounded(by.x * per_unit), rounded(by.y * per_unit), rounded(by.z * per_unit)}};
  shift.is_zero = shift.by == Shift().by;
  return shift;
}

/// Those near the part, thinned where they lie and then moved.
void CellCandidates::append_run(const CellScene& scene, CellLayer& layer, CellLayer::Run run,
                                const Shift& shift) {
  if (run.size() == 0) return;
  work_.gathered += run.size();
  const std::int64_t most = std::int64_t{count_} + run.size();
  if (around_.size() < static_cast<std::size_t>(most) + kChunk) {
    index_count(most, "points and images of points near one cell", "take a smaller cutoff",
                kMaxIndexCount - 2 * kChunk);
    around_.make_room(static_cast<std::size_t>(most) + kChunk);
  }
  BlockSpan span = span_;
  for (std::size_t axis = 0; axis < 3 && !shift.is_zero; ++axis)
    span.center[axis] = static_cast<std::int16_t>(static_cast<std::uint16_t>(
        static_cast<std::uint16_t>(span.center[axis]) - static_cast<std::uint16_t>(shift.by[axis])));
  Candidates from = layer.at(run.begin);
  if (from.tag == nullptr) from.tag = around_.at(0).tag;  // for kernels that do not look at it
  const Candidates to = around_.at(count_);
  const std::int32_t kept =
      keep_near(*kernels_, scene.requests[0].limits, span, size_, from, nullptr, run.size(), to);
  if (!shift.is_zero) kernels_->shift(to, shift.by.data(), kept);
  count_ += kept;
}

}  // namespace dch::detail
