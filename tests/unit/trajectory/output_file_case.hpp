// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <gmock/gmock.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <string>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <dch/trajectory/file_error.hpp>
#include <dch/trajectory/output_file.hpp>

#include "scratch_folder.hpp"

namespace dch::trajectory::test {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Files in a folder of its own.
class OutputFileTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  std::string create(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  std::size_t files() const { return folder_.files(); }
  static std::string content(const std::string& file) { return read_file(file); }

  /// Writes the file as a whole.
  static void put(const std::string& file, const std::string& text) {
    OutputFile output(file);
    output.write(text);
    output.commit();
  }
  static mode_t mode_of(const std::string& file) { return status_of(file).st_mode & mode_t{07777}; }
  static struct stat status_of(const std::string& file) {
    struct stat status {};
    EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
    return status;
  }
  void expect_refused(const std::string& file, const std::string& reason) const {
    const std::size_t before = files();
    EXPECT_THAT([&] { OutputFile output(file); },
                ThrowsMessage<FileError>(AllOf(HasSubstr(file + ": "), HasSubstr(reason))));
    EXPECT_EQ(files(), before);
  }

 private:
  ScratchFolder folder_;
};

/// Runs the action in a process of its own; returns how that ended, as waitpid tells it.
inline int in_a_child(const std::function<void()>& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    action();
    ::_exit(0);
  }
  int status = -1;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return status;
}

/// Runs the action as a user who may not do everything, and tells whether it returned true.
inline bool as_another_user(const std::function<bool()>& action) {
  constexpr id_t kNobody = 65534;
  return in_a_child([&] {
           if (::geteuid() == 0 &&
               (::setgroups(0, nullptr) != 0 || ::setgid(kNobody) != 0 || ::setuid(kNobody) != 0)) {
             ::_exit(2);
           }
           ::_exit(action() ? 0 : 1);
         }) == 0;
}

}  // namespace dch::trajectory::test
