// SPDX-License-Identifier: MIT
#include "temporary_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

#include "place.hpp"

namespace dch::trajectory {
namespace {

/// Makes an empty file under a name that nobody has: .NAME.PROCESS.NUMBER.tmp in the folder of the final
/// file.
std::string create_beside(const std::string& final_path) {
  const std::filesystem::path target(final_path);
  constexpr int kAttempts = 1000;
  constexpr mode_t kMode = 0666;  // less the user's umask, as for any new file
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::string name = fmt::format(".{}.{}.{}.tmp", target.filename().string(), ::getpid(), attempt);
    std::string path = (target.parent_path() / name).string();
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
    if (descriptor >= 0) {
      ::close(descriptor);
      return path;
    }
    if (errno != EEXIST) break;
  }
  fail(final_path, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace

TemporaryFile::TemporaryFile(std::string final_path) : final_path_(std::move(final_path)) {
  if (std::error_code ignored; std::filesystem::is_directory(final_path_, ignored)) {
    fail(final_path_, "cannot be written: it is a folder");
  }
  path_ = create_beside(final_path_);
}

TemporaryFile::~TemporaryFile() {
  if (!committed_) ::unlink(path_.c_str());
}

void TemporaryFile::commit() {
  const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  const bool on_disk = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!on_disk) fail(final_path_, std::string("cannot be brought to the disk: ") + std::strerror(reason));
  if (std::rename(path_.c_str(), final_path_.c_str()) != 0) {
    fail(final_path_, std::string("cannot be given its name: ") + std::strerror(errno));
  }
  committed_ = true;
}

}  // namespace dch::trajectory
