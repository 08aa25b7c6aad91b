// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "report/crossing_report.hpp"
#include "report/hdf5_file.hpp"

namespace dch::cli {

/// Writes crossings to an HDF5 file, frame by frame. docs/formats.md describes the file. All functions throw
/// trajectory::FileError, the disk being full, say.
class CrossingFile {
 public:
  CrossingFile(const std::string& path, const CrossingReport& report);

  void append(const CrossingFrame& frame, const std::vector<CrossingEvent>& events);
  /// Completes the file and gives it its name.
  void commit() { file_.commit(); }

 private:
  Hdf5File file_;
};

}  // namespace dch::cli
