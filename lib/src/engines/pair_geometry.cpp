// SPDX-License-Identifier: MIT
#include "engines/pair_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "geometry/lattice.hpp"

namespace dch::detail {
namespace {

/// Doubles as large as this are whole, and so are sums with it: less than 2^51 is rounded by it to the
/// nearest whole number.
constexpr double kRounder = 0x1.8p52;

double nearest_whole(double x) { return (x + kRounder) - kRounder; }

bool is_along(Vec3 v, std::size_t axis) {
  for (std::size_t other = 0; other < 3; ++other)
    if (other != axis && v[static_cast<int>(other)] != 0) return false;
  return true;
}

/// As an integer, without an instruction that SSE2 lacks: the low bits of the sum with kRounder.
std::int64_t as_integer(double whole) {
  const double sum = whole + kRounder;
  std::int64_t bits = 0, zero = 0;
  std::memcpy(&bits, &sum, sizeof bits);
  std::memcpy(&zero, &kRounder, sizeof zero);
  return bits - zero;
}

}  // namespace

void PairChunk::count_shifts(int count) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int k = 0; k < count; ++k) whole_shift[axis][k] = as_integer(shift[axis][k]);
}

void PairChunk::take_distances(int count) {
  const auto& [x, y, z] = displacement;
  for (int k = 0; k < count; ++k) distance[k] = std::sqrt(x[k] * x[k] + y[k] * y[k] + z[k] * z[k]);
}

PairGeometry::PairGeometry(Span<const Vec3> given, const HomeImages& home, const Box& box)
    : given_(given.data()), home_(home), is_periodic_(box.any_periodic()) {
  const Lattice lattice(box);
  std::size_t rank = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!box.periodic(static_cast<int>(axis))) continue;
    cell_[axis] = box.vector(static_cast<int>(axis));
    is_axis_parallel_ = is_axis_parallel_ && is_along(cell_[axis], axis);
    dual_[rank] = box.reduced_dual()[rank];
    integers_[rank] = lattice.integers(box.reduced()[rank]);
    is_axis_parallel_ = is_axis_parallel_ && norm2(integers_[rank]) == 1;
    ++rank;
  }
  if (is_axis_parallel_) {  // each reduced vector is one of the cell or its opposite: in the place of its
                            // axis
    std::array<Vec3, 3> dual{};
    for (std::size_t k = 0; k < rank; ++k)
      for (int axis = 0; axis < 3; ++axis)
        if (integers_[k][axis] != 0) dual[static_cast<std::size_t>(axis)] = integers_[k][axis] * dual_[k];
    dual_ = dual;
  }
  are_at_home_ = std::equal(given.begin(), given.end(), home.positions.begin());
}

void PairGeometry::measure(std::int32_t i, const std::int32_t* j, int count, PairChunk& out) const {
  differences(given_, i, j, count, out.displacement);
  if (!is_periodic_) {
    for (auto& column : out.shift) std::fill_n(column.begin(), count, 0);
    return;
  }
  if (are_at_home_) {
    round_shifts(out.displacement, count, out.shift);
  } else {
    Columns home;
    differences(home_.positions.data(), i, j, count, home);
    round_shifts(home, count, out.shift);
    add_home_shifts(i, j, count, out.shift);
  }
  add_cells(count, out.shift, out.displacement);
}

void PairGeometry::differences(const Vec3* positions, std::int32_t i, const std::int32_t* j, int count,
                               Columns& out) {
  const Vec3 from = positions[i];
  for (int k = 0; k < count; ++k) {
    const Vec3& to = positions[j[k]];
    out[0][k] = to.x - from.x;
    out[1][k] = to.y - from.y;
    out[2][k] = to.z - from.z;
  }
}

void PairGeometry::round_shifts(const Columns& home, int count, Columns& shift) const {
  const double *const x = home[0].data(), *const y = home[1].data(), *const z = home[2].data();
  double *const a = shift[0].data(), *const b = shift[1].data(), *const c = shift[2].data();
  if (is_axis_parallel_) {
    const double u = -dual_[0].x, v = -dual_[1].y, w = -dual_[2].z;
    for (int k = 0; k < count; ++k) {
      a[k] = nearest_whole(u * x[k]);
      b[k] = nearest_whole(v * y[k]);
      c[k] = nearest_whole(w * z[k]);
    }
    return;
  }
  const std::array<Vec3, 3> dual = dual_, integers = integers_;
  for (int k = 0; k < count; ++k) {
    const Vec3 d{x[k], y[k], z[k]};
    const double n0 = nearest_whole(-dot(dual[0], d)), n1 = nearest_whole(-dot(dual[1], d)),
                 n2 = nearest_whole(-dot(dual[2], d));
    a[k] = n0 * integers[0].x + n1 * integers[1].x + n2 * integers[2].x;
    b[k] = n0 * integers[0].y + n1 * integers[1].y + n2 * integers[2].y;
    c[k] = n0 * integers[0].z + n1 * integers[1].z + n2 * integers[2].z;
  }
}

void PairGeometry::add_home_shifts(std::int32_t i, const std::int32_t* j, int count, Columns& shift) const {
  const HomeImages::Shift from = home_.shifts[static_cast<std::size_t>(i)];
  for (int k = 0; k < count; ++k) {
    const HomeImages::Shift& to = home_.shifts[static_cast<std::size_t>(j[k])];
    for (std::size_t axis = 0; axis < 3; ++axis) shift[axis][k] += to[axis] - from[axis];
  }
}

/// In the order of the definition: x_j - x_i, and then each vector of the cell.
void PairGeometry::add_cells(int count, const Columns& shift, Columns& displacement) const {
  const double *const a = shift[0].data(), *const b = shift[1].data(), *const c = shift[2].data();
  double *const x = displacement[0].data(), *const y = displacement[1].data(),
                *const z = displacement[2].data();
  const std::array<Vec3, 3> cell = cell_;
  if (is_axis_parallel_) {
    for (int k = 0; k < count; ++k) {
      x[k] += a[k] * cell[0].x;
      y[k] += b[k] * cell[1].y;
      z[k] += c[k] * cell[2].z;
    }
    return;
  }
  for (int k = 0; k < count; ++k) {
    x[k] = ((x[k] + a[k] * cell[0].x) + b[k] * cell[1].x) + c[k] * cell[2].x;
    y[k] = ((y[k] + a[k] * cell[0].y) + b[k] * cell[1].y) + c[k] * cell[2].y;
    z[k] = ((z[k] + a[k] * cell[0].z) + b[k] * cell[1].z) + c[k] * cell[2].z;
  }
}

}  // namespace dch::detail
