// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <filesystem>
#include <stdlib.h>
#include <string>
#include <unistd.h>

#include "fuzz_input.hpp"

namespace dch::fuzz {

/// A file of a given name whose content changes from input to input, in a folder of its own that goes with
/// the process. It stays open: some file systems write a file to the disk when one that was truncated is
/// closed.
class InputOnDisk {
 public:
  explicit InputOnDisk(const std::string& name) {
    std::string pattern = (std::filesystem::temp_directory_path() / "dch-fuzz-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) fail("no folder for temporary files");
    folder_ = pattern;
    path_ = (folder_ / name).string();
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file_ < 0) fail("no temporary file");
  }
  ~InputOnDisk() {
    ::close(file_);
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  InputOnDisk(const InputOnDisk&) = delete;
  InputOnDisk& operator=(const InputOnDisk&) = delete;

  /// Returns the path.
  const std::string& write(const std::string& content) {
    const auto size = static_cast<off_t>(content.size());
    if (::pwrite(file_, content.data(), content.size(), 0) != size || ::ftruncate(file_, size) != 0)
      fail("the temporary file cannot be written");
    return path_;
  }

 private:
  std::filesystem::path folder_;
  std::string path_;
  int file_ = -1;
};

}  // namespace dch::fuzz
