// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <dch/trajectory/reader.hpp>

#include "child_process.hpp"

namespace dch::trajectory {

/// Makes the reader that does the work; called in the child process.
using ReaderFactory = std::function<std::unique_ptr<TrajectoryReader>()>;

/// Runs another reader in a child process and hands its frames on.
///
/// A broken file may lead a library that the project does not control (HDF5) out of its arrays or into an
/// endless loop. In a child process each of these becomes a FileError. The child reads ahead while the caller
/// works on the last frame.
class ForkedReader final : public TrajectoryReader {
 public:
  /// @param seconds_per_frame processor time after which a frame that has not come is taken for an endless
  /// loop [s]
  /// @throws FileError that the factory throws, or if the child process ends in it or cannot be started.
  ForkedReader(std::string path, ReaderFactory make_reader, int seconds_per_frame = 120);

  bool read(Frame& frame) override;
  std::string format() const override { return format_; }
  std::string length_unit() const override { return length_unit_; }

 private:
  void start(ReaderFactory make_reader, int seconds_per_frame);
  [[noreturn]] void fail_for_child();

  std::string path_;
  std::string format_;
  std::string length_unit_;
  std::unique_ptr<ChildProcess> child_;
  bool at_end_ = false;
  std::int64_t frames_ = 0;
};

}  // namespace dch::trajectory
