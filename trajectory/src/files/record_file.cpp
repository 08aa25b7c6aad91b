// SPDX-License-Identifier: MIT
#include "files/record_file.hpp"

#include <fmt/format.h>

#include "base/byte_order.hpp"
#include "base/place.hpp"

namespace dch::trajectory {
namespace {

constexpr std::int64_t kMarker = sizeof(std::int32_t);

}  // namespace

const std::vector<unsigned char>& RecordFile::next(const char* what) {
  const std::int64_t length = read_length(offset_, what);
  if (length < 0) fail_here(fmt::format("expected the length of {}, found {}", what, length));
  if (length > file_.size() - offset_ - 2 * kMarker) {
    fail_here(
        fmt::format("{} of {} bytes begins here, but the file ends at byte {}: it is truncated or broken",
                    what, length, file_.size()));
  }
  data_.resize(static_cast<std::size_t>(length));
  if (file_.read_at(offset_ + kMarker, data_.data(), data_.size()) != data_.size()) {
    fail_here(fmt::format("the file ends inside {}", what));
  }
  const std::int64_t behind = read_length(offset_ + kMarker + length, what);
  if (behind != length) {
    fail_here(fmt::format("{} begins with the length {} but ends with {}: the file is broken", what, length,
                          behind));
  }
  last_offset_ = offset_;
  offset_ += length + 2 * kMarker;
  return data_;
}

const std::vector<unsigned char>& RecordFile::next(const char* what, std::int64_t size) {
  const std::int64_t length = read_length(offset_, what);
  if (length != size)
    fail_here(fmt::format("expected {} of {} bytes, found a length of {}", what, size, length));
  return next(what);
}

std::int64_t RecordFile::read_length(std::int64_t at, const char* what) const {
  std::int32_t raw = 0;
  if (file_.read_at(at, &raw, sizeof raw) != sizeof raw) {
    fail_here(fmt::format("the file ends inside the length of {}: it is truncated", what));
  }
  return decode<std::int32_t>(&raw, order_);
}

void RecordFile::fail_here(const std::string& what) const {
  fail_at_byte(file_.path(), frame_, offset_, what);
}

void RecordFile::fail_in_last(const std::string& what) const {
  fail_at_byte(file_.path(), frame_, last_offset_, what);
}

}  // namespace dch::trajectory
