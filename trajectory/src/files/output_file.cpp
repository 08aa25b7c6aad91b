// SPDX-License-Identifier: MIT
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <dch/trajectory/output_file.hpp>

#include "base/place.hpp"
#include "files/unfinished_files.hpp"

namespace dch::trajectory {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kPermissions = 0777;

/// Repeats a system call that a signal has interrupted.
template <class Call>
auto repeat(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// The path behind all symbolic links, of a file that need not exist: renaming onto a link would replace the
/// link.
std::string follow_links(const std::string& path) {
  constexpr int kMaxLinks = 40;  // as Linux allows
  fs::path target(path);
  for (int links = 0; links < kMaxLinks; ++links) {
    std::error_code no_link;
    const fs::path next = fs::read_symlink(target, no_link);
    if (no_link) return target.string();
    target = target.parent_path() / next;  // `next` alone if it is absolute
  }
  fail(path, std::string("cannot be written: ") + std::strerror(ELOOP));
}

const char* describe_kind(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

bool is_same_file(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

/// Signals wait while it lives, so that none comes between the making of a file and the note of its name.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t all;
    sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~HeldSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), final_path_(follow_links(path)) {
  if (path_ == "-")
    fail_here("standard output is no file; give the name of one, or ./- for one of that name");
  if (fs::path(final_path_).filename().empty()) fail_here("cannot be written, since it names a folder");
  struct stat named {
  }, found{}, stream{};
  const bool exists = ::stat(path_.c_str(), &named) == 0;
  if (!exists && errno != ENOENT) fail_here("cannot be written", errno);
  if (exists && !S_ISREG(named.st_mode)) {
    fail_here(fmt::format("cannot be written, since it is {} and not a regular file; give the name of a file",
                          describe_kind(named.st_mode)));
  }
  // The links in /proc lead to files that have lost their names, too.
  if (exists && (::stat(final_path_.c_str(), &found) != 0 || !is_same_file(named, found))) {
    fail_here("cannot be written, since the file that it leads to has no name any more");
  }
  for (const int number : {STDOUT_FILENO, STDERR_FILENO}) {
    if (exists && ::fstat(number, &stream) == 0 && is_same_file(named, stream)) {
      fail_here("cannot be written, since what is printed goes there; give the name of another file");
    }
  }
  if (exists && ::faccessat(AT_FDCWD, final_path_.c_str(), W_OK, AT_EACCESS) != 0) {
    fail_here("cannot be written", errno);
  }
  create(exists);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  forget_unfinished_file(place_);
}

/// Makes an empty file under a name that nobody has, .NAME.PROCESS.NUMBER.partial in the folder of the file.
void OutputFile::create(bool replaces_file) {
  constexpr int kAttempts = 1000;            // runs that were killed leave their files behind
  constexpr std::size_t kLongestStem = 200;  // of the 255 bytes that a name may have
  constexpr mode_t kPrivate = 0600;          // what it replaces may be for one user's eyes only
  constexpr mode_t kLikeAnyOther = 0666;     // less the user's umask
  const fs::path folder = folder_of(final_path_);
  const std::string stem = fs::path(final_path_).filename().string().substr(0, kLongestStem);
  const HeldSignals held;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    temporary_ = (folder / fmt::format(".{}.{}.{}.partial", stem, ::getpid(), attempt)).string();
    descriptor_ = repeat([&] {
      return ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                    replaces_file ? kPrivate : kLikeAnyOther);
    });
    if (descriptor_ >= 0) {
      place_ = note_unfinished_file(temporary_);
      return;
    }
    if (errno != EEXIST)
      fail_here(fmt::format("cannot be written: no file can be made in {}", folder.string()), errno);
  }
  fail_here(fmt::format(
      "cannot be written: {} unfinished files of earlier runs are in the way; remove {}/.{}.*.partial",
      kAttempts, folder.string(), stem));
}

std::string OutputFile::descriptor_path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

void OutputFile::write(std::string_view bytes) {
  assert(descriptor_ >= 0);
  while (!bytes.empty()) {
    const ssize_t done = repeat([&] { return ::write(descriptor_, bytes.data(), bytes.size()); });
    if (done < 0) fail_here("cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

void OutputFile::commit() {
  assert(descriptor_ >= 0);
  hand_on_attributes();
  if (repeat([&] { return ::fsync(descriptor_); }) != 0) fail_here("cannot be brought to the disk", errno);
  close();
  if (repeat([&] { return std::rename(temporary_.c_str(), final_path_.c_str()); }) != 0) {
    fail_here("cannot be given its name", errno);
  }
  temporary_.clear();
  sync_folder();
}

void OutputFile::hand_on_attributes() {
  struct stat old {
  }, own{};
  if (::lstat(final_path_.c_str(), &old) != 0) return;  // a new file
  if (!S_ISREG(old.st_mode)) {
    fail_here(
        fmt::format("cannot be written, since {} has got its name meanwhile", describe_kind(old.st_mode)));
  }
  // Only the superuser may give files away, and others may choose among their own groups.
  constexpr auto kAsItIs = static_cast<uid_t>(-1);
  [[maybe_unused]] const bool handed_on =
      ::fchown(descriptor_, old.st_uid, old.st_gid) == 0 || ::fchown(descriptor_, kAsItIs, old.st_gid) == 0;
  if (::fstat(descriptor_, &own) != 0) fail_here("cannot be written", errno);
  mode_t mode = old.st_mode & kPermissions;
  // What was for the members of one group is not for those of another.
  if (own.st_gid != old.st_gid) mode = (mode & ~mode_t{S_IRWXG}) | ((mode & S_IRWXO) << 3);
  if (repeat([&] { return ::fchmod(descriptor_, mode); }) != 0)
    fail_here("cannot be given its permissions", errno);
}

void OutputFile::close() {
  // Interrupted or not, the descriptor is closed: a second attempt would close somebody else's.
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail_here("cannot be completed", errno);
}

void OutputFile::sync_folder() const {
  const int folder =
      repeat([&] { return ::open(folder_of(final_path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  if (folder < 0 && errno == EACCES) return;  // it may be written to but not read: the system decides when
  // Some file systems cannot bring a folder to the disk and say EINVAL.
  const bool on_disk = folder >= 0 && (repeat([&] { return ::fsync(folder); }) == 0 || errno == EINVAL);
  const int reason = errno;
  if (folder >= 0) ::close(folder);
  if (!on_disk) fail_here("is complete, but its folder cannot be brought to the disk", reason);
}

void OutputFile::fail_here(const std::string& what) const { fail(path_, what); }

void OutputFile::fail_here(const std::string& what, int reason) const {
  fail(path_, fmt::format("{}: {}", what, std::strerror(reason)));
}

}  // namespace dch::trajectory
