// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include <dch/trajectory/frame.hpp>

namespace dch::trajectory {

/// Writes frames to a new file. The file appears under its name only when close() succeeds: until then it is
/// written beside it under a temporary name, which the destructor removes.
class TrajectoryWriter {
 public:
  virtual ~TrajectoryWriter() = default;
  /// @throws FileError if the disk is full or the frame cannot be expressed in the format.
  virtual void write(const Frame& frame) = 0;
  /// Completes the file. @throws FileError.
  virtual void close() = 0;
};

/// Creates a writer by file name: .h5 .h5md (H5MD), .lammpstrj .dump (LAMMPS text dump).
/// @param length_unit recorded in the file where the format has a place for it
/// @throws FileError if the folder cannot be written to or the ending is unknown.
std::unique_ptr<TrajectoryWriter> create_trajectory(const std::string& path, const std::string& length_unit);

}  // namespace dch::trajectory
