// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "input_file.hpp"

namespace dch::trajectory {

/// Walks over the big-endian numbers of an XDR file (RFC 4506).
class XdrCursor {
 public:
  explicit XdrCursor(const std::string& path) : file_(path) {}

  std::int64_t offset() const { return offset_; }
  bool at_end() const { return offset_ >= file_.size(); }
  const std::string& path() const { return file_.path(); }
  std::int64_t file_size() const { return file_.size(); }

  /// The frame that messages name.
  void set_frame(std::int64_t frame) { frame_ = frame; }

  /// @param what names the number in the message if the file ends in front of its end. @throws FileError.
  std::int32_t read_int(const char* what);
  /// @param size 4 or 8 bytes
  double read_real(const char* what, std::int64_t size = 4);
  /// `count` numbers. @throws FileError unless all are finite.
  std::vector<double> read_finite_reals(const char* what, std::int64_t count, std::int64_t size = 4);
  std::string read_bytes(const char* what, std::int64_t count);
  /// Steps over `count` bytes and the padding to a multiple of four.
  void skip(const char* what, std::int64_t count);

  /// Throws FileError naming the byte where the number read last begins.
  [[noreturn]] void fail_here(const std::string& what) const;

 private:
  void take(const char* what, void* bytes, std::int64_t count);

  InputFile file_;
  std::int64_t frame_ = 0;
  std::int64_t offset_ = 0;
  std::int64_t last_offset_ = 0;
};

}  // namespace dch::trajectory
