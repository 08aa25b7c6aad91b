// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/progress_bar.hpp"
#include "input/chain_topology.hpp"
#include "input/trajectory_input.hpp"
#include "options/option_values.hpp"
#include "report/crossing_report.hpp"

namespace dch::cli {

/// `dchmd crossings` as asked for on the command line, its numbers checked.
struct CrossingOptions {
  TrajectoryInput input;
  ChainSource chains;
  double thickness = 0;
  FrameRange frames;
  int threads = 1;
  std::string data;  ///< an HDF5 file; empty: none
};

/// Reads the selected frames and finds the bonds that cross between each and the next (CrossingFinder). The
/// data file is in place when this returns.
/// @throws UsageError for options that do not fit the file, trajectory::FileError for files that cannot be
/// read
///   or written, chains that do not fit the trajectory, and positions that are none.
CrossingReport analyze_crossings(const CrossingOptions& options, ProgressBar& progress);

}  // namespace dch::cli
