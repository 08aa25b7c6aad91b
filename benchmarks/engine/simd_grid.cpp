// SPDX-License-Identifier: MIT
#include "simd_grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "block_span.hpp"
#include "grid_kernels.hpp"
#include "leaves/rounding.hpp"

namespace dch::bench {

using detail::rounded;

void SimdGrid::Candidates::make_room(std::size_t count) {
  if (id.size() >= count) return;
  for (auto* axis : {&x, &y, &z}) axis->resize(count);
  id.resize(count);
}

void SimdGrid::lay_out(Span<const Vec3> positions, const Box& box) {
  double widest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    periodic_[static_cast<std::size_t>(axis)] = box.periodic(axis);
    if (box.periodic(axis)) {
      low_[axis] = box.origin()[axis];
      length_[axis] = box.vector(axis)[axis];
    } else {
      const auto by_axis = [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; };
      const auto [least, most] = std::minmax_element(positions.begin(), positions.end(), by_axis);
      low_[axis] = (*least)[axis];
      length_[axis] = std::max((*most)[axis] - (*least)[axis], width_) * (1 + 1e-12);
    }
    const auto k = static_cast<std::size_t>(axis);
    counts_[k] = std::max(1, static_cast<std::int32_t>(std::floor(length_[axis] / width_)));
    cell_[axis] = length_[axis] / counts_[k];
    reach_[k] = static_cast<std::int32_t>(std::ceil(radius_ / cell_[axis]));
    if (periodic_[k] && counts_[k] < 2 * reach_[k] + 1)
      throw std::invalid_argument("SimdGrid: the box is too small for its stencil");
    widest = std::max(widest, (reach_[k] + 1) * cell_[axis]);
  }
  unit_ = detail::finest_unit(widest);
  const double in_units = radius_ / unit_, limit = in_units * in_units / 0x1p15;
  const double off = std::sqrt(27.0) / 2;
  const double band = (2 * off * in_units + off * off) / 0x1p15 + 1.5 + 1e-6;
  in_ = static_cast<std::int16_t>(std::clamp(std::floor(limit - band) + 1, 0.0, 32767.0));
  out_ = static_cast<std::int16_t>(std::clamp(std::floor(limit + band) + 1, 0.0, 32767.0));
}

void SimdGrid::make_stencil() {
  const auto gap = [&](std::int32_t d, int axis) { return std::max(0, std::abs(d) - 1) * cell_[axis]; };
  stencil_.clear();
  own_reach_ = reach_[0];
  for (std::int32_t dz = 0; dz <= reach_[2]; ++dz)
    for (std::int32_t dy = dz == 0 ? 1 : -reach_[1]; dy <= reach_[1]; ++dy) {
      const double left2 = radius_ * radius_ - gap(dy, 1) * gap(dy, 1) - gap(dz, 2) * gap(dz, 2);
      if (left2 < 0) continue;
      stencil_.push_back(
          {dy, dz, std::min(reach_[0], static_cast<std::int32_t>(std::sqrt(left2) / cell_.x) + 1)});
    }
}

void SimdGrid::sort_points(Span<const Vec3> positions) {
  const std::size_t n = positions.size();
  key_.resize(n);
  sorted_.make_room(n + kChunk);
  around_.make_room(n + kChunk);  // unsorted coordinates, for the time being
  const Vec3 per_cell{1 / cell_.x, 1 / cell_.y, 1 / cell_.z};
  const double per_unit = 1 / unit_;
  for (std::size_t i = 0; i < n; ++i) {
    Cell at{};
    Vec3 d = positions[i] - low_;
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      if (periodic_[k] && (d[axis] < 0 || d[axis] >= length_[axis]))
        d[axis] -= length_[axis] * std::floor(d[axis] / length_[axis]);
      at[k] = std::clamp(static_cast<std::int32_t>(d[axis] * per_cell[axis]), 0, counts_[k] - 1);
    }
    key_[i] = key_of(at);
    around_.x[i] = rounded(d.x * per_unit);
    around_.y[i] = rounded(d.y * per_unit);
    around_.z[i] = rounded(d.z * per_unit);
  }
  number_cells();
  next_.assign(first_.begin(), first_.end());
  for (std::size_t i = 0; i < n; ++i) {
    const auto to = static_cast<std::size_t>(next_[static_cast<std::size_t>(cell_of_[i])]++);
    sorted_.x[to] = around_.x[i];
    sorted_.y[to] = around_.y[i];
    sorted_.z[to] = around_.z[i];
    sorted_.id[to] = static_cast<std::int32_t>(i);
  }
}

/// Cell of each point, and where the points of each cell begin.
void SimdGrid::number_cells() {
  cell_of_.resize(key_.size());
  std::size_t cells;
  if (kind_ == Cells::dense) {
    cells = static_cast<std::size_t>(counts_[0]) * static_cast<std::size_t>(counts_[1]) *
            static_cast<std::size_t>(counts_[2]);
    for (std::size_t i = 0; i < key_.size(); ++i) cell_of_[i] = static_cast<std::int32_t>(key_[i]);
  } else {
    find_occupied();
    cells = occupied_.size();
  }
  first_.assign(cells + 1, 0);
  for (const std::int32_t cell : cell_of_) ++first_[static_cast<std::size_t>(cell) + 1];
  for (std::size_t cell = 0; cell < cells; ++cell) first_[cell + 1] += first_[cell];
}

/// Slot of a key in the table, or the free one where it belongs.
std::size_t SimdGrid::slot_of(std::int64_t key) const {
  std::size_t slot = (static_cast<std::uint64_t>(key) * 0x9E3779B97F4A7C15u >> 20) & (table_.size() - 1);
  while (table_[slot].key != key && table_[slot].key >= 0) slot = (slot + 1) & (table_.size() - 1);
  return slot;
}

/// Numbers the occupied cells by their keys, so that the points of neighbors along x lie side by side.
void SimdGrid::find_occupied() {
  std::size_t size = 64;
  while (size < 2 * key_.size()) size *= 2;
  table_.assign(size, {-1, 0});
  occupied_.clear();
  for (std::size_t i = 0; i < key_.size(); ++i) {
    const std::size_t slot = slot_of(key_[i]);
    if (table_[slot].key < 0) {
      table_[slot] = {key_[i], 0};
      occupied_.push_back(key_[i]);
    }
    cell_of_[i] = static_cast<std::int32_t>(slot);
  }
  std::sort(occupied_.begin(), occupied_.end());
  for (std::size_t cell = 0; cell < occupied_.size(); ++cell)
    table_[slot_of(occupied_[cell])].cell = static_cast<std::int32_t>(cell);
  for (std::int32_t& cell : cell_of_) cell = table_[static_cast<std::size_t>(cell)].cell;
}

/// The points of the cells with keys first .. last, which lie in one row.
SimdGrid::Run SimdGrid::points_of(std::int64_t first, std::int64_t last) const {
  if (kind_ == Cells::dense)
    return {first_[static_cast<std::size_t>(first)], first_[static_cast<std::size_t>(last) + 1]};
  for (std::int64_t key = first; key <= last; ++key) {
    const Slot& slot = table_[slot_of(key)];
    if (slot.key < 0) continue;
    const auto begin = static_cast<std::size_t>(slot.cell);
    std::size_t end = begin + 1;
    while (end < occupied_.size() && occupied_[end] <= last) ++end;
    return {first_[begin], first_[end]};
  }
  return {};
}

void SimdGrid::list(Span<const Vec3> positions, const Box& box, const Exclusions& exclusions,
                    NeighborList& out) {
  exclusions_ = exclusions.empty() ? nullptr : &exclusions;
  kernels_ = &frozen_kernels(instruction_set());
  lay_out(positions, box);
  make_stencil();
  sort_points(positions);
  out.kind = ListKind::half;
  out.first.assign(1, 0);
  out.particle.clear();
  out.j.resize(out.j.capacity());
  const auto decode = [&](std::int64_t key) {
    const std::int64_t x = key % counts_[0], yz = key / counts_[0];
    return Cell{static_cast<std::int32_t>(x), static_cast<std::int32_t>(yz % counts_[1]),
                static_cast<std::int32_t>(yz / counts_[1])};
  };
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
    if (first_[cell] == first_[cell + 1]) continue;
    const std::int64_t key = kind_ == Cells::dense ? static_cast<std::int64_t>(cell) : occupied_[cell];
    rows_of_cell({first_[cell], first_[cell + 1]}, decode(key), positions, box, out);
  }
}

std::size_t SimdGrid::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t bytes = bytes_of(key_) + bytes_of(cell_of_) + bytes_of(first_) + bytes_of(occupied_) +
                      bytes_of(table_) + bytes_of(next_) + bytes_of(mask_) + bytes_of(unsettled_) +
                      bytes_of(stencil_);
  for (const Candidates* points : {&sorted_, &around_, &near_})
    bytes += 3 * bytes_of(points->x) + bytes_of(points->id);
  return bytes;
}

void SimdGrid::append(Run run, const std::array<std::int16_t, 3>& shift) {
  const std::int32_t length = run.end - run.begin;
  if (length == 0) return;
  around_.make_room(static_cast<std::size_t>(count_ + length + kChunk));
  copy_shifted(sorted_.at(static_cast<std::size_t>(run.begin)), shift, length,
               around_.at(static_cast<std::size_t>(count_)));
  count_ += length;
}

/// Cells at[0] + first .. at[0] + last of the row (dy, dz) away.
void SimdGrid::append_row(const Cell& at, std::int32_t dy, std::int32_t dz, std::int32_t first,
                          std::int32_t last) {
  Cell row{0, at[1] + dy, at[2] + dz};
  std::array<std::int16_t, 3> shift{};
  for (std::size_t axis : {1u, 2u}) {
    const int period = row[axis] < 0 ? -1 : row[axis] >= counts_[axis] ? 1 : 0;
    if (period == 0) continue;
    if (!periodic_[axis]) return;
    row[axis] -= period * counts_[axis];
    shift[axis] = rounded(period * length_[static_cast<int>(axis)] / unit_);
  }
  std::int32_t x = at[0] + first;
  const std::int32_t end = at[0] + last + 1;
  while (x < end) {
    const int period = x < 0 ? -1 : x >= counts_[0] ? 1 : 0;
    const std::int32_t stop = period < 0 ? std::min(end, 0) : period == 0 ? std::min(end, counts_[0]) : end;
    if (period == 0 || periodic_[0]) {
      shift[0] = rounded(period * length_.x / unit_);
      row[0] = x - period * counts_[0];
      const std::int64_t key = key_of(row);
      append(points_of(key, key + stop - x - 1), shift);
    }
    x = stop;
  }
}

void SimdGrid::rows_of_cell(Run own, const Cell& at, Span<const Vec3> positions, const Box& box,
                            NeighborList& out) {
  count_ = 0;
  append(own, {});
  append_row(at, 0, 0, 1, own_reach_);
  for (const Row& row : stencil_) append_row(at, row.dy, row.dz, -row.dx, row.dx);
  const BlockSpan span = span_of(sorted_.at(static_cast<std::size_t>(own.begin)), own.end - own.begin);
  near_.make_room(static_cast<std::size_t>(count_) + kChunk);
  count_ = kernels_->filter(span, out_, around_.at(0), count_, around_.at(0));
  const auto chunks = static_cast<std::size_t>(count_ / kChunk + 1);
  if (mask_.size() < kBlock * chunks) {
    mask_.resize(kBlock * chunks);
    unsettled_.resize(kBlock * chunks);
  }
  for (std::int32_t begin = own.begin; begin < own.end; begin += kBlock)
    rows_of_block({begin, std::min(begin + kBlock, own.end)}, begin - own.begin, positions, box, out);
}

void SimdGrid::rows_of_block(Run block, std::int32_t before, Span<const Vec3> positions, const Box& box,
                             NeighborList& out) {
  const auto first = static_cast<std::size_t>(block.begin);
  const std::int32_t rows = block.end - block.begin;
  BlockPoints points{};
  for (std::int32_t lane = 0; lane < rows; ++lane) {
    points.x[lane] = sorted_.x[first + static_cast<std::size_t>(lane)];
    points.y[lane] = sorted_.y[first + static_cast<std::size_t>(lane)];
    points.z[lane] = sorted_.z[first + static_cast<std::size_t>(lane)];
  }
  const detail::Candidates near = near_.at(0);
  const std::int32_t count =
      kernels_->filter(span_of(sorted_.at(first), rows), out_, around_.at(static_cast<std::size_t>(before)),
                       count_ - before, near);
  const std::int32_t chunks = (count + kChunk - 1) / kChunk;
  const std::int32_t left =
      kernels_->test(points, near, count, in_, out_, mask_.data(), chunks, unsettled_.data());
  for (std::int32_t u = 0; u < left; ++u) {
    const auto [row, chunk, open] = unsettled_[static_cast<std::size_t>(u)];
    if (row >= rows) continue;
    for (std::uint32_t rest = open; rest != 0; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      if (chunk == 0 && lane <= row) continue;
      const auto i = static_cast<std::size_t>(sorted_.id[first + static_cast<std::size_t>(row)]);
      const auto j = static_cast<std::size_t>(near.id[chunk * kChunk + lane]);
      if (box.distance2(positions[i], positions[j]) <= radius_ * radius_)
        mask_[static_cast<std::size_t>(row * chunks + chunk)] |= 1u << lane;
    }
  }
  auto written = static_cast<std::size_t>(out.first.back());
  const std::size_t most = written + static_cast<std::size_t>(kBlock * kChunk * chunks + kChunk);
  if (out.j.size() < most) out.j.resize(most + most / 4);
  for (std::int32_t row = 0; row < rows; ++row) {
    std::uint32_t* const mask = mask_.data() + row * chunks;
    mask[0] &= ~0u << (row + 1);
    std::int32_t* const to = out.j.data() + written;
    const std::int32_t particle = sorted_.id[first + static_cast<std::size_t>(row)];
    std::int32_t length = kernels_->compress(mask, chunks, near.id, to);
    if (exclusions_) {
      const Span<const std::int32_t> partners = exclusions_->partners(particle);
      length = kernels_->leave_out(to, length, partners.data(), static_cast<std::int32_t>(partners.size()));
    }
    written += static_cast<std::size_t>(length);
    out.particle.push_back(particle);
    out.first.push_back(static_cast<std::int64_t>(written));
  }
}

}  // namespace dch::bench
