// SPDX-License-Identifier: MIT
#include "files/input_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "base/place.hpp"

namespace dch::trajectory {
namespace {

/// Refuses what only looks like a file (a folder, a device, a pipe): the readers need a size.
std::int64_t regular_file_size(int descriptor, const std::string& path) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail(path, std::string("cannot be read: ") + std::strerror(errno));
  if (S_ISDIR(status.st_mode)) fail(path, "is a folder; a trajectory file is expected");
  if (!S_ISREG(status.st_mode)) fail(path, "is not a regular file");
  if (status.st_size == 0) fail(path, "is empty");
  return status.st_size;
}

}  // namespace

InputFile::InputFile(std::string path) : path_(std::move(path)) {
  // Opened first and looked at then, so that both are the same file. Without O_NONBLOCK a pipe would keep the
  // program waiting for somebody to write into it; for regular files the flag means nothing.
  do {
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  } while (descriptor_ < 0 && errno == EINTR);
  if (descriptor_ < 0) fail(path_, std::string("cannot be opened: ") + std::strerror(errno));
  try {
    size_ = regular_file_size(descriptor_, path_);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

InputFile::InputFile(InputFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      position_(other.position_) {}

std::size_t InputFile::read_some(char* data, std::size_t size) {
  const std::size_t got = read_at(position_, data, size);
  position_ += static_cast<std::int64_t>(got);
  return got;
}

std::size_t InputFile::read_at(std::int64_t offset, void* data, std::size_t size) const {
  const std::int64_t available = std::max<std::int64_t>(size_ - offset, 0);
  const std::size_t wanted = std::min(size, static_cast<std::size_t>(available));
  std::size_t done = 0;
  while (done < wanted) {
    const ssize_t got = ::pread(descriptor_, static_cast<char*>(data) + done, wanted - done,
                                offset + static_cast<off_t>(done));
    if (got == 0) break;  // somebody cut the file while it was being read
    if (got < 0 && errno != EINTR) fail(path_, std::string("cannot be read: ") + std::strerror(errno));
    if (got > 0) done += static_cast<std::size_t>(got);
  }
  return done;
}

bool InputFile::starts_with(std::string_view magic) const {
  std::string head(magic.size(), '\0');
  return read_at(0, head.data(), head.size()) == magic.size() && head == magic;
}

}  // namespace dch::trajectory
