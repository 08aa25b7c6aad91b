// SPDX-License-Identifier: MIT
#include "gromacs/xdr_cursor.hpp"

#include <bit>
#include <cmath>
#include <fmt/format.h>

#include "base/byte_order.hpp"

namespace dch::trajectory {

std::int32_t XdrCursor::read_int(const char* what) {
  return decode<std::int32_t>(take(what, 4).data(), std::endian::big);
}

std::int64_t XdrCursor::read_long(const char* what) {
  return decode<std::int64_t>(take(what, 8).data(), std::endian::big);
}

double XdrCursor::read_real(const char* what, std::int64_t size) {
  const Bytes bytes = take(what, size);
  if (size == 8) return decode<double>(bytes.data(), std::endian::big);
  return static_cast<double>(decode<float>(bytes.data(), std::endian::big));
}

double XdrCursor::read_finite_real(const char* what, std::int64_t size) {
  const double value = read_real(what, size);
  if (!std::isfinite(value)) fail_here(fmt::format("{} holds {}", what, value));
  return value;
}

Vec3 XdrCursor::read_finite_vector(const char* what, std::int64_t size) {
  Vec3 vector;
  for (int axis = 0; axis < 3; ++axis) vector[axis] = read_finite_real(what, size);
  return vector;
}

Cell XdrCursor::read_cell(std::int64_t size) {
  Cell cell;
  for (Vec3& edge : cell.edges) edge = read_finite_vector("the box", size);
  return cell;
}

std::string XdrCursor::read_text(const char* what, std::int64_t count) {
  const Bytes bytes = take(what, count);
  return {bytes.begin(), bytes.end()};
}

Bytes XdrCursor::take(const char* what, std::int64_t count) {
  last_offset_ = offset_;
  const auto size = static_cast<std::int64_t>(bytes_.size());
  if (count < 0 || count > size - offset_) {
    fail_here(fmt::format("the file ends {} bytes on, inside {}: it is truncated", size - offset_, what));
  }
  offset_ += count;
  return bytes_.subspan(static_cast<std::size_t>(last_offset_), static_cast<std::size_t>(count));
}

}  // namespace dch::trajectory
