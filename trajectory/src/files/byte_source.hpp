// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>

namespace dch::trajectory {

/// Compressed data that are broken or end early. LineReader turns it into a FileError with frame and line.
class BrokenStream : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A stream of bytes, read from the front to the end.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Reads up to `size` bytes; 0 only at the end.
  /// @throws FileError if the file cannot be read; BrokenStream.
  virtual std::size_t read(char* data, std::size_t size) = 0;
  virtual bool is_compressed() const { return false; }
};

/// Opens a file, unpacking it on the way if it starts with the gzip magic (whatever its name).
/// @throws FileError if it does not exist, cannot be read or is empty.
std::unique_ptr<ByteSource> open_byte_source(const std::string& path);

}  // namespace dch::trajectory
