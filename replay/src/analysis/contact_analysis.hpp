// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include <dch/necklace/contacts.hpp>
#include <dch/trajectory/reader.hpp>

#include "base/progress_bar.hpp"
#include "input/bead_radii.hpp"
#include "input/trajectory_input.hpp"
#include "options/option_values.hpp"
#include "report/contact_report.hpp"

namespace dch::cli {

/// `dchmd contacts` as asked for on the command line, its numbers checked.
struct ContactOptions {
  TrajectoryInput input;
  ChainSource chains;
  necklace::ContactQuery query;
  BeadRadii radii{"0"};
  std::int32_t bins = 512;  ///< at most, of the contact map
  FrameRange frames;
  int threads = 1;   ///< to find contacts with
  std::string data;  ///< contacts.h5; empty: none
};

/// Reads the selected frames, finds their contacts with the structure that suits the scene (ContactFinder),
/// and follows them. The data file is in place when this returns.
/// @throws UsageError for options that do not fit the file (a gap beyond what half the smallest box height
///   allows, frames in an order that time does not have, no chains named); trajectory::FileError for files
///   that cannot be read or written, chains that do not fit the trajectory and bonds of half the box and
///   more.
ContactReport analyze_contacts(const ContactOptions& options, ProgressBar& progress);

}  // namespace dch::cli
