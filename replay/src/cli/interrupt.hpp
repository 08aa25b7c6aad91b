// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>
#include <cstddef>
#include <memory>
#include <string>

#include <dch/executor.hpp>

namespace dch::cli {

/// From here on SIGINT, SIGTERM and SIGHUP remove the files that are not finished, print a line and end the
/// process at once, with the status that shells report for the signal (130, 143, 129), wherever it is: no
/// loop has to ask. Those that the process was started to ignore (nohup, jobs in the background) stay
/// ignored.
void catch_interrupts();

/// Names a file that is to be removed if one of these signals ends the process before it has its final name.
class UnfinishedFile {
 public:
  /// @throws std::logic_error for more than kMost files at once, which no subcommand writes.
  explicit UnfinishedFile(std::string path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  static constexpr std::size_t kMost = 16;

 private:
  std::string path_;
  std::size_t slot_ = 0;
};

/// These signals wait while it lives: between the making of a file and its UnfinishedFile.
class HoldInterrupts {
 public:
  HoldInterrupts();
  ~HoldInterrupts();
  HoldInterrupts(const HoldInterrupts&) = delete;
  HoldInterrupts& operator=(const HoldInterrupts&) = delete;

 private:
  sigset_t before_;
};

/// make_thread_pool() with threads that leave these signals to the thread that makes files.
std::unique_ptr<Executor> make_threads(int threads);

}  // namespace dch::cli
