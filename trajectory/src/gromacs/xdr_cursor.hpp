// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "frames/cell.hpp"
#include "frames/frame_decoder.hpp"

namespace dch::trajectory {

/// Walks over the big-endian numbers of XDR data (RFC 4506) in memory. All functions throw BrokenFrame where
/// the bytes end too early.
class XdrCursor {
 public:
  explicit XdrCursor(Bytes bytes) : bytes_(bytes) {}

  std::int64_t offset() const { return offset_; }

  /// @param what names the number in the message
  std::int32_t read_int(const char* what);
  std::int64_t read_long(const char* what);
  /// @param size 4 or 8 bytes
  double read_real(const char* what, std::int64_t size = 4);
  /// @throws BrokenFrame also for a number that is not finite.
  double read_finite_real(const char* what, std::int64_t size = 4);
  Vec3 read_finite_vector(const char* what, std::int64_t size = 4);
  /// Three edge vectors, one number after the other, periodic along all axes.
  Cell read_cell(std::int64_t size = 4);
  std::string read_text(const char* what, std::int64_t count);
  Bytes take(const char* what, std::int64_t count);

  /// Throws BrokenFrame naming the byte where the number read last begins.
  [[noreturn]] void fail_here(const std::string& what) const { throw BrokenFrame(last_offset_, what); }

 private:
  Bytes bytes_;
  std::int64_t offset_ = 0;
  std::int64_t last_offset_ = 0;
};

}  // namespace dch::trajectory
