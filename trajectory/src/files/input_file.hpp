// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dch::trajectory {

/// A regular file open for reading. Its size is taken when it is opened: what a running simulation appends
/// later is not seen.
class InputFile {
 public:
  /// @throws FileError if the file does not exist, is not a regular file, cannot be read or is empty.
  explicit InputFile(std::string path);
  ~InputFile();
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&&) = delete;
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }
  std::int64_t size() const { return size_; }
  int descriptor() const { return descriptor_; }

  /// Reads up to `size` bytes from where the last read_some() ended; 0 only at the end. @throws FileError.
  std::size_t read_some(char* data, std::size_t size);

  /// Reads up to `size` bytes from `offset`; fewer only at the end. @throws FileError.
  std::size_t read_at(std::int64_t offset, void* data, std::size_t size) const;

  bool starts_with(std::string_view magic) const;

 private:
  std::string path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
  std::int64_t position_ = 0;
};

}  // namespace dch::trajectory
