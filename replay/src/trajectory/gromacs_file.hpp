// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include <dch/trajectory/frame.hpp>

namespace dch::trajectory {

/// A trajectory file read by libgromacs. Use it in a child process only: libgromacs may end the process.
class GromacsFile {
 public:
  explicit GromacsFile(std::string path);
  ~GromacsFile();
  GromacsFile(const GromacsFile&) = delete;
  GromacsFile& operator=(const GromacsFile&) = delete;

  /// Reads the next frame with positions: step, time, box, positions. False at what libgromacs takes for the
  /// end.
  /// @throws InvalidBox.
  bool read(Frame& frame);

 private:
  struct Impl;
  std::string path_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch::trajectory
