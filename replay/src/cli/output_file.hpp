// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "interrupt.hpp"

namespace dch::cli {

/// A file that appears under its name only once it is complete: until commit() it is written beside it under
/// a temporary name, which the destructor removes. A file that already has the name is then replaced.
class OutputFile {
 public:
  /// Creates the temporary file, so that a path that cannot be written to is found out before any work is
  /// done.
  /// @throws trajectory::FileError if that fails, or if something other than a regular file has the name.
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& temporary_path() const { return temporary_; }

  /// Replaces the content of the temporary file. @throws trajectory::FileError, the disk being full, say.
  void write(std::string_view content);

  /// Gives the file its name. @throws trajectory::FileError.
  void commit();

 private:
  std::string path_;
  std::string temporary_;
  std::optional<UnfinishedFile> unfinished_;
};

/// Nothing if no name was given. @throws trajectory::FileError.
inline std::unique_ptr<OutputFile> open_output(const std::string& path) {
  return path.empty() ? nullptr : std::make_unique<OutputFile>(path);
}

}  // namespace dch::cli
