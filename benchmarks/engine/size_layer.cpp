// SPDX-License-Identifier: MIT
#include "size_layer.hpp"

#include <algorithm>
#include <cmath>

#include "grid_kernels.hpp"

namespace dch::bench {
namespace {
/// Cells are counted in 32 bits, and where spheres are few, going through more of them takes longer than
/// wider ones do: so many at most, or so many for each sphere.
constexpr double kMostCells = 1 << 20, kMostCellsForEach = 8;
}  // namespace

void SizeLayer::set_up(std::vector<std::int32_t> members, Span<const double> radii, double largest_of_all,
                       double side, double at_least, double skin) {
  members_ = std::move(members);
  side_ = side;
  const auto radius = [&](std::int32_t i) { return radii[static_cast<std::size_t>(i)]; };
  least = most = radius(members_.front());
  words_.clear();
  for (const std::int32_t i : members_) {
    least = std::min(least, radius(i));
    most = std::max(most, radius(i));
    const auto code = static_cast<std::int32_t>(std::lround(radius(i) / largest_of_all * kMaxCode));
    words_.push_back(code << kNumberBits | i);
  }
  const double most_cells = std::max(kMostCells, kMostCellsForEach * static_cast<double>(members_.size()));
  cells_ = std::max(1, static_cast<std::int32_t>(std::min(side / at_least, std::cbrt(most_cells))));
  width = side / cells_;
  const std::size_t room = members_.size() + detail::kChunk;
  for (auto* axis : {&x, &y, &z}) axis->assign(room, 0);
  word.assign(room, 0);
  cell_of_.resize(members_.size());
  unsorted_.resize(members_.size());
  make_stencil(skin);
}

void SizeLayer::make_stencil(double skin) {
  const double reach = 2 * most + skin;
  reach_ = static_cast<std::int32_t>(std::ceil(reach / width));
  stencil_.clear();
  const auto gap = [&](std::int32_t d) { return std::max(0, std::abs(d) - 1) * width; };
  for (std::int32_t dz = 0; dz <= reach_; ++dz)
    for (std::int32_t dy = dz == 0 ? 1 : -reach_; dy <= reach_; ++dy) {
      const double left2 = reach * reach - gap(dy) * gap(dy) - gap(dz) * gap(dz);
      if (left2 >= 0)
        stencil_.push_back(
            {dy, dz, std::min(reach_, static_cast<std::int32_t>(std::sqrt(left2) / width) + 1)});
    }
}

void SizeLayer::sort(Span<const Vec3> positions) {
  const double per_side = 1 / side_, per_cell = cells_ * 0x1p-32;
  first_.assign(static_cast<std::size_t>(cell_count()) + 1, 0);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const Vec3 p = positions[static_cast<std::size_t>(members_[k])];
    std::array<std::int32_t, 3> at{};
    for (int axis = 0; axis < 3; ++axis) {
      double part = p[axis] * per_side;
      part -= std::floor(part);
      const auto fraction = static_cast<std::uint32_t>(static_cast<std::int64_t>(part * 0x1p32));
      unsorted_[k][static_cast<std::size_t>(axis)] = fraction;
      at[static_cast<std::size_t>(axis)] =
          std::min(static_cast<std::int32_t>(fraction * per_cell), cells_ - 1);
    }
    cell_of_[k] = (at[2] * cells_ + at[1]) * cells_ + at[0];
    ++first_[static_cast<std::size_t>(cell_of_[k]) + 1];
  }
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) first_[cell + 1] += first_[cell];
  next_.assign(first_.begin(), first_.end());
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const auto to = static_cast<std::size_t>(next_[static_cast<std::size_t>(cell_of_[k])]++);
    x[to] = unsorted_[k][0];
    y[to] = unsorted_[k][1];
    z[to] = unsorted_[k][2];
    word[to] = words_[k];
  }
}

std::size_t SizeLayer::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  return bytes_of(x) + bytes_of(y) + bytes_of(z) + bytes_of(word) + bytes_of(members_) + bytes_of(words_) +
         bytes_of(first_) + bytes_of(cell_of_) + bytes_of(next_) + bytes_of(unsorted_) + bytes_of(stencil_);
}

}  // namespace dch::bench
