// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

namespace dch::bench {

/// Particles of similar radius in the order of the cells of a periodic cube, coordinates as fractions of
/// 2^32.
class SizeLayer {
 public:
  using Cell = std::array<std::int32_t, 3>;
  struct Run {
    std::int32_t begin = 0, end = 0;
  };

  /// @param members numbers of its particles
  /// @param width of its cells at least [length]
  void set_up(std::vector<std::int32_t> members, Span<const double> radii, double largest_of_all, double side,
              double width, double skin);
  /// Puts the particles into their cells.
  void sort(Span<const Vec3> positions);

  std::int32_t size() const { return static_cast<std::int32_t>(members_.size()); }
  /// Whether the box has too few cells for a stencil; then particles are to be treated one by one.
  bool is_coarse() const { return cells_ < 2 * reach_ + 1; }
  std::int32_t cell_count() const { return cells_ * cells_ * cells_; }
  Cell cell(std::int32_t number) const {
    return {number % cells_, number / cells_ % cells_, number / (cells_ * cells_)};
  }
  Run particles(std::int32_t cell_number) const { return {first_[cell_number], first_[cell_number + 1]}; }
  /// Calls visit(run) for the runs of particles in the half stencil after a cell.
  template <class Visit>
  void half_stencil(const Cell& at, const Visit& visit) const {
    along_x(at[1], at[2], at[0] + 1, reach_, visit);
    for (const Row& row : stencil_)
      along_x(wrapped(at[1] + row.dy), wrapped(at[2] + row.dz), at[0] - row.dx, 2 * row.dx + 1, visit);
  }
  /// Calls visit(run) for runs that hold all particles within `distance` of a box [length].
  template <class Visit>
  void near_box(Vec3 low, Vec3 high, double distance, const Visit& visit) const;

  double width = 0;            ///< of a cell [length]
  double least = 0, most = 0;  ///< radius of the members [length]
  std::vector<std::uint32_t> x, y, z;
  std::vector<std::int32_t> word;  ///< number and radius, see unpack()

  std::size_t memory_bytes() const;

 private:
  struct Row {
    std::int32_t dy, dz, dx;  ///< cells x - dx .. x + dx of a row
  };
  std::int32_t wrapped(std::int32_t c) const { return c < 0 ? c + cells_ : c >= cells_ ? c - cells_ : c; }
  void make_stencil(double skin);

  template <class Visit>
  void along_x(std::int32_t cy, std::int32_t cz, std::int32_t start, std::int32_t count,
               const Visit& visit) const {
    const std::size_t row = (static_cast<std::size_t>(cz) * cells_ + cy) * cells_;
    start = wrapped(start);
    const std::int32_t stop = start + count, inside = stop < cells_ ? stop : cells_;
    visit(Run{first_[row + start], first_[row + inside]});
    if (stop > cells_) visit(Run{first_[row], first_[row + stop - cells_]});
  }

  double side_ = 0;
  std::int32_t cells_ = 1, reach_ = 1;  ///< cells along an axis; cells that the stencil extends
  std::vector<Row> stencil_;
  std::vector<std::int32_t> members_, words_;  ///< of each member
  std::vector<std::int32_t> first_, cell_of_, next_;
  std::vector<std::array<std::uint32_t, 3>> unsorted_;
};

template <class Visit>
void SizeLayer::near_box(Vec3 low, Vec3 high, double distance, const Visit& visit) const {
  struct Range {
    std::int32_t first, count;  ///< first is not wrapped; all cells of the box from 0 if they are that many
  };
  const double per_width = 1 / width;
  distance += 1e-9 * side_;  // so that rounding leaves out no cell
  const auto range = [&](double from, double to) {
    if (to - from >= side_) return Range{0, cells_};
    // Adding a period makes the numbers positive, where to cut off is to round down.
    const std::int32_t first = static_cast<std::int32_t>((from + side_) * per_width) - cells_;
    const std::int32_t last = static_cast<std::int32_t>((to + side_) * per_width) - cells_;
    return last - first + 1 >= cells_ ? Range{0, cells_} : Range{first, last - first + 1};
  };
  const auto gap2 = [&](const Range& whole, double from, double to, std::int32_t k) {
    const double begin = (whole.first + k) * width;
    const double gap = whole.count == cells_ ? 0 : std::max({0.0, from - begin - width, begin - to});
    return gap * gap;
  };
  const Range ys = range(low.y - distance, high.y + distance),
              zs = range(low.z - distance, high.z + distance);
  for (std::int32_t kz = 0; kz < zs.count; ++kz) {
    const double left2_z = distance * distance - gap2(zs, low.z, high.z, kz);
    for (std::int32_t ky = 0; ky < ys.count; ++ky) {
      const double left2 = left2_z - gap2(ys, low.y, high.y, ky);
      if (left2 < 0) continue;
      const double dx = std::sqrt(left2);
      const Range xs = range(low.x - dx, high.x + dx);
      along_x(wrapped(ys.first + ky), wrapped(zs.first + kz), xs.first, xs.count, visit);
    }
  }
}

}  // namespace dch::bench
