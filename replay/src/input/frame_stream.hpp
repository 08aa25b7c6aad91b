// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <dch/trajectory/reader.hpp>

#include "base/progress_bar.hpp"
#include "input/trajectory_input.hpp"
#include "input/trajectory_summary.hpp"
#include "options/option_values.hpp"

namespace dch::cli {

/// The selected frames of a trajectory file, one after the other.
class FrameStream {
 public:
  /// @throws trajectory::FileError as open_trajectory.
  FrameStream(const TrajectoryInput& input, const FrameRange& range);

  /// Reads on to the next selected frame; false when there is none.
  /// @throws trajectory::FileError as TrajectoryReader::read.
  bool next(trajectory::Frame& frame);

  std::int64_t index() const { return passed_ - 1; }  ///< of the frame last read, from 0
  std::int64_t passed() const { return passed_; }     ///< frames read so far, selected or not
  const trajectory::TrajectoryReader& reader() const { return *reader_; }

 private:
  FrameRange range_;
  std::unique_ptr<trajectory::TrajectoryReader> reader_;
  std::int64_t passed_ = 0;
};

/// What one pass over the selected frames tells about a trajectory.
struct Scan : TrajectorySummary {
  std::int64_t frames = 0;  ///< selected
  std::int64_t last_step = 0;
  std::optional<double> last_time;
  bool has_times = true;          ///< each frame has a time
  bool atoms_change = false;      ///< some frame has other ids than the one before
  trajectory::Frame first_frame;  ///< the first selected frame
};

/// Reads all selected frames once: every broken frame is found here, before any work has been done.
/// @throws trajectory::FileError if the file is broken or holds no frame; UsageError if the range selects
/// none.
Scan scan_trajectory(const TrajectoryInput& input, const FrameRange& range, ProgressBar& progress);

/// The file is not the one that was scanned. @throws trajectory::FileError.
[[noreturn]] void fail_changed(const std::string& path);

}  // namespace dch::cli
