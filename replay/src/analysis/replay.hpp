// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <dch/lists/neighbor_list.hpp>
#include <dch/trajectory/reader.hpp>

#include "base/progress_bar.hpp"
#include "engines/engine.hpp"
#include "engines/verifier.hpp"
#include "input/trajectory_input.hpp"
#include "options/option_values.hpp"
#include "report/replay_report.hpp"

namespace dch::cli {

/// A replay as asked for on the command line, its numbers checked.
struct ReplayOptions {
  TrajectoryInput input;
  std::string topology;  ///< empty: bonds come from the molecule column where needed
  double cutoff = 0;     ///< > 0 [length]
  double skin = 0;       ///< >= 0 [length]
  EngineOptions engine;
  int threads = 1;  ///< to keep the structure and make the lists with (dch only)
  FrameRange frames;
  VerifyMode verify = VerifyMode::none;
  ListKind kind = ListKind::half;
  int exclude_depth = 0;    ///< 0: nothing; 1, 2, 3: 1-2, 1-3, 1-4 neighbors
  bool continuous = false;  ///< look at what is between frames, too
  std::string lists;        ///< lists.h5; empty: none
  std::string view;         ///< page that shows the frames in space; empty: none
};

/// Reads the selected frames, keeps one structure and one list up through them, and verifies and writes the
/// lists. lists.h5 and the view are in place when this returns.
/// @throws UsageError for options that do not fit the file (a cutoff beyond half the smallest box height,
/// exclusions
///   without bonds, --continuous with one frame, a view that is too large); trajectory::FileError for files
///   that cannot be read or written.
ReplayReport run_replay(const ReplayOptions& options, ProgressBar& progress);

}  // namespace dch::cli
