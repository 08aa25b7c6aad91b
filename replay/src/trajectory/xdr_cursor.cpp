// SPDX-License-Identifier: MIT
#include "xdr_cursor.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>

#include "byte_order.hpp"
#include "place.hpp"

namespace dch::trajectory {

std::int32_t XdrCursor::read_int(const char* what) {
  std::array<char, 4> bytes{};
  take(what, bytes.data(), bytes.size());
  return decode<std::int32_t>(bytes.data(), std::endian::big);
}

double XdrCursor::read_real(const char* what, std::int64_t size) {
  std::array<char, 8> bytes{};
  take(what, bytes.data(), size);
  if (size == 8) return decode<double>(bytes.data(), std::endian::big);
  return static_cast<double>(decode<float>(bytes.data(), std::endian::big));
}

std::vector<double> XdrCursor::read_finite_reals(const char* what, std::int64_t count, std::int64_t size) {
  std::vector<double> values;
  for (std::int64_t k = 0; k < count; ++k) {
    values.push_back(read_real(what, size));
    if (!std::isfinite(values.back())) fail_here(fmt::format("{} holds {}", what, values.back()));
  }
  return values;
}

std::string XdrCursor::read_bytes(const char* what, std::int64_t count) {
  std::string bytes(static_cast<std::size_t>(count), '\0');
  take(what, bytes.data(), count);
  return bytes;
}

void XdrCursor::skip(const char* what, std::int64_t count) {
  const std::int64_t padded = (count + 3) / 4 * 4;
  last_offset_ = offset_;
  if (padded > file_.size() - offset_) {
    fail_here(fmt::format("{} of {} bytes begins here, but the file ends at byte {}: it is truncated", what,
                          padded, file_.size()));
  }
  offset_ += padded;
}

void XdrCursor::take(const char* what, void* bytes, std::int64_t count) {
  last_offset_ = offset_;
  const auto wanted = static_cast<std::size_t>(count);
  if (file_.read_at(offset_, bytes, wanted) != wanted) {
    fail_here(fmt::format("the file ends at byte {}, inside {}: it is truncated", file_.size(), what));
  }
  offset_ += count;
}

void XdrCursor::fail_here(const std::string& what) const {
  fail_at_byte(file_.path(), frame_, last_offset_, what);
}

}  // namespace dch::trajectory
