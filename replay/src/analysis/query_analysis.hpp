// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/progress_bar.hpp"
#include "input/trajectory_input.hpp"
#include "options/option_values.hpp"
#include "report/query_report.hpp"

namespace dch::cli {

/// `dchmd query` as asked for on the command line, its numbers checked.
struct QueryOptions {
  TrajectoryInput input;
  std::int32_t k = 1;           ///< nearest atoms of each
  std::vector<double> cutoffs;  ///< of clusters, ascending; empty: none are asked for [length]
  FrameRange frames;
  int threads = 1;
  std::string data;  ///< query.h5; empty: none
};

/// Keeps one hierarchy up over the selected frames and asks it for the nearest atoms of each, the closest
/// pair and the clusters. The data file is in place when this returns.
/// @throws UsageError for frames that are not there; trajectory::FileError for files that cannot be read or
///   written and positions that are no numbers.
QueryReport analyze_proximity(const QueryOptions& options, ProgressBar& progress);

}  // namespace dch::cli
