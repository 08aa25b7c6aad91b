// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace dch::trajectory {

/// A new file beside the one it is to become. commit() gives it the final name in one step, so that nobody
/// ever sees a half-written file there; without commit() the destructor removes it.
class TemporaryFile {
 public:
  /// @throws FileError if the folder cannot be written to or the final name is that of a folder.
  explicit TemporaryFile(std::string final_path);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Where to write to.
  const std::string& path() const { return path_; }
  const std::string& final_path() const { return final_path_; }

  /// Brings the bytes to the disk and renames the file, replacing one that has the final name. Close it
  /// first.
  /// @throws FileError.
  void commit();

 private:
  std::string final_path_;
  std::string path_;
  bool committed_ = false;
};

}  // namespace dch::trajectory
