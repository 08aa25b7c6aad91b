// SPDX-License-Identifier: MIT
#include "output_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

#include <dch/trajectory/file_error.hpp>

namespace dch::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const char* action, int error_number) {
  throw trajectory::FileError(
      fmt::format("{}: cannot {}: {}; check the folder, its permissions and the free space", path, action,
                  std::strerror(error_number)));
}

/// The file a symbolic link names: renaming onto the link would replace the link.
std::string follow_link(const std::string& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target.string();
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(follow_link(path)) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw trajectory::FileError(
        fmt::format("{}: cannot be written, since it is {} and not a regular file; give the "
                    "name of a file",
                    path, fs::is_directory(status) ? "a folder" : "a device, pipe or socket"));
  }
  const std::string name = fmt::format("{}.partial-{}", path_, ::getpid());
  const HoldInterrupts hold;
  const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(path, "create it", errno);
  ::close(descriptor);
  temporary_ = name;
  unfinished_.emplace(temporary_);
}

OutputFile::~OutputFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view content) {
  std::FILE* file = std::fopen(temporary_.c_str(), "wbe");
  if (!file) fail(path_, "write it", errno);
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  const int write_error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written) fail(path_, "write it", write_error);
  if (!closed) fail(path_, "complete it", errno);
}

void OutputFile::commit() {
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "give it its name", errno);
  temporary_.clear();
}

}  // namespace dch::cli
