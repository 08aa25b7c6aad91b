// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <dch/trajectory/reader.hpp>

#include "process/child_process.hpp"
#include "process/child_rights.hpp"

namespace dch::trajectory {

/// Makes the reader that does the work; called in the child process.
using ReaderFactory = std::function<std::unique_ptr<TrajectoryReader>()>;

/// What a child process may take.
struct ChildBounds {
  /// Processor time after which a frame that has not come is taken for an endless loop; five times as much on
  /// the clock [s]
  int seconds_per_frame = 120;
  std::optional<ChildRights>
      rights;  ///< given up before the reader is made, but for these; none: all are kept
};

/// Runs another reader in a child process and hands its frames on.
///
/// A broken file may lead a library that the project does not control (HDF5) out of its arrays or into an
/// endless loop, or make it do what the file's author wants. In a child process without rights each of these
/// becomes a FileError, and what the child sends is checked as the file would be. The child reads ahead while
/// the caller works on the last frame.
class ForkedReader final : public TrajectoryReader {
 public:
  /// @throws FileError that the factory throws, or if the child process ends in it or cannot be started.
  ForkedReader(std::string path, ReaderFactory make_reader, ChildBounds bounds = {});

  bool read(Frame& frame) override;
  std::string format() const override { return format_; }
  std::string length_unit() const override { return length_unit_; }

 private:
  void start(ReaderFactory make_reader, ChildBounds bounds);
  [[noreturn]] void fail_for_child();

  std::string path_;
  std::string format_;
  std::string length_unit_;
  std::unique_ptr<ChildProcess> child_;
  bool at_end_ = false;
  std::int64_t frames_ = 0;
};

}  // namespace dch::trajectory
