// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "files/input_file.hpp"

namespace dch::trajectory {

/// Fortran's sequential records: each stands between two copies of its length in bytes (32 bits).
class RecordFile {
 public:
  explicit RecordFile(const InputFile& file) : file_(file) {}

  void set_order(std::endian order) { order_ = order; }
  /// The frame that messages name.
  void set_frame(std::int64_t frame) { frame_ = frame; }

  std::int64_t offset() const { return offset_; }
  void skip_to(std::int64_t offset) { offset_ = offset; }
  bool at_end() const { return offset_ >= file_.size(); }

  /// Reads the record at offset() and steps behind it; valid until the next call.
  /// @throws FileError if the file ends inside it or the two lengths differ.
  const std::vector<unsigned char>& next(const char* what);
  /// As next(), for a record that must be `size` bytes long.
  const std::vector<unsigned char>& next(const char* what, std::int64_t size);

  /// Throws FileError naming the byte where the next record begins.
  [[noreturn]] void fail_here(const std::string& what) const;
  /// Throws FileError naming the byte where the record read last begins.
  [[noreturn]] void fail_in_last(const std::string& what) const;

 private:
  std::int64_t read_length(std::int64_t at, const char* what) const;

  const InputFile& file_;
  std::endian order_ = std::endian::little;
  std::int64_t frame_ = 0;
  std::int64_t offset_ = 0;
  std::int64_t last_offset_ = 0;
  std::vector<unsigned char> data_;
};

}  // namespace dch::trajectory
