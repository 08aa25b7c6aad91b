// SPDX-License-Identifier: MIT
#include "input/trajectory_input.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <dch/trajectory/file_error.hpp>

#include "base/interrupt.hpp"
#include "options/command_line.hpp"
#include "options/read_options.hpp"

namespace dch::cli {
namespace {

using trajectory::FileError;

/// The text with the one name in place of the other.
std::string renamed(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Has errors name what the user named.
class NamedReader final : public trajectory::TrajectoryReader {
 public:
  NamedReader(std::unique_ptr<TrajectoryReader> reader, std::string path, std::string name)
      : reader_(std::move(reader)), path_(std::move(path)), name_(std::move(name)) {}

  bool read(trajectory::Frame& frame) override try {
    return reader_->read(frame);
  } catch (const FileError& error) {
    throw FileError(renamed(error.what(), path_, name_));
  }
  std::string format() const override { return reader_->format(); }
  std::string length_unit() const override { return reader_->length_unit(); }

 private:
  std::unique_ptr<TrajectoryReader> reader_;
  std::string path_, name_;
};

std::string descriptor_path(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

std::shared_ptr<const int> owned(int descriptor) {
  return {new int(descriptor), [](const int* number) {
            ::close(*number);
            delete number;
          }};
}

/// A new file without a name: nothing is left of it when the process has ended, however it ends.
int make_nameless_file(const std::string& name) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  std::string path = (error ? std::filesystem::path("/tmp") : folder) / "dch-input-XXXXXX";
  const HoldInterrupts hold;
  const int descriptor = ::mkostemp(path.data(), O_CLOEXEC);
  if (descriptor < 0) {
    throw FileError(fmt::format("{}: cannot be kept in {}: {}; name another folder with the variable TMPDIR",
                                name, path, std::strerror(errno)));
  }
  ::unlink(path.c_str());
  return descriptor;
}

bool is_pipe(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode));
}

/// A file that standard input comes from, from its beginning, can be opened as any other.
bool is_whole_file(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
         ::lseek(descriptor, 0, SEEK_CUR) == 0;
}

std::string known_formats() { return fmt::format("{}", fmt::join(trajectory::trajectory_formats(), ", ")); }

/// What --format or, without it, the ending of the name says; empty if neither is known.
std::string format_of(const InputWords& words) {
  std::string name = words.format.empty() ? words.file : "x." + words.format;
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  if (words.format.empty()) std::transform(name.begin(), name.end(), name.begin(), lower);
  for (const std::string& format : trajectory::trajectory_formats()) {
    if (name.size() > format.size() + 1 && name.ends_with("." + format)) return format;
  }
  return "";
}

void require_format(const InputWords& words) {
  if (!format_of(words).empty()) return;
  if (!words.format.empty()) {
    throw UsageError(
        fmt::format("--format '{}': not known; choose one of {}", words.format, known_formats()));
  }
  if (words.file == "-") {
    throw UsageError("standard input has no name to tell its format; give it with --format, one of " +
                     known_formats());
  }
  throw FileError(fmt::format(
      "{}: unknown kind of trajectory; the endings known are .{}; for another name give one of them, "
      "without the dot, with --format",
      words.file, fmt::join(trajectory::trajectory_formats(), " .")));
}

}  // namespace

void add_input_options(Command& command, InputWords& words, const std::string& argument,
                       const std::string& help) {
  add_file_option(command, argument, words.file, help + "; - for standard input")->required()->type_name("");
  command
      .add_option("--format", words.format,
                  "Format of the trajectory, by the ending that names of such files have: lammpstrj, dcd, "
                  "xtc, ... Default: as the name says; standard input has none")
      ->type_name("NAME");
  add_max_expanded(command, words.max_expanded);
}

TrajectoryInput::TrajectoryInput(const InputWords& words)
    : name_(words.file),
      path_(words.file),
      format_(words.format),
      limits_(parse_max_expanded(words.max_expanded)) {
  require_format(words);
  if (words.file == "-") {
    name_ = "standard input";
    path_ = descriptor_path(STDIN_FILENO);
    if (!is_whole_file(STDIN_FILENO)) copy(STDIN_FILENO);
  } else if (is_pipe(path_)) {
    format_ = format_of(words);
    require_format_of_pipes();  // before it is opened, which waits for whoever writes into it
    const auto pipe = owned(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
    copy(*pipe);
  }
}

void TrajectoryInput::require_format_of_pipes() const {
  if (format_ != "h5" && format_ != "h5md") return;
  throw UsageError(name_ +
                   ": H5MD cannot be read from a pipe, since HDF5 opens files by their names alone; "
                   "save it to a file and name that");
}

void TrajectoryInput::copy(int descriptor) {
  require_format_of_pipes();
  copy_ = owned(make_nameless_file(name_));
  path_ = descriptor_path(*copy_);
  std::vector<char> bytes(std::size_t{1} << 20);
  for (;;) {
    const ssize_t got = ::read(descriptor, bytes.data(), bytes.size());
    if (got == 0) return;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw FileError(fmt::format("{}: cannot be read: {}", name_, std::strerror(errno)));
    for (ssize_t done = 0; done < got;) {
      const ssize_t put = ::write(*copy_, bytes.data() + done, static_cast<std::size_t>(got - done));
      if (put < 0 && errno == EINTR) continue;
      if (put < 0) {
        throw FileError(
            fmt::format("{}: cannot be copied to a temporary file: {}; name a folder with more room with the "
                        "variable TMPDIR",
                        name_, std::strerror(errno)));
      }
      done += put;
    }
  }
}

std::unique_ptr<trajectory::TrajectoryReader> TrajectoryInput::open() const try {
  auto reader = trajectory::open_trajectory(path_, format_, limits_);
  if (path_ == name_) return reader;
  return std::make_unique<NamedReader>(std::move(reader), path_, name_);
} catch (const FileError& error) {
  throw FileError(renamed(error.what(), path_, name_));
}

}  // namespace dch::cli
