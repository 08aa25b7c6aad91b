// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/trajectory/frame.hpp>

namespace dch::trajectory {

/// Reads the frames of a trajectory file one after the other.
class TrajectoryReader {
 public:
  virtual ~TrajectoryReader() = default;

  /// Reads the next frame; false at the end of the file.
  ///
  /// A LAMMPS dump with ids may hold other atoms in each frame, so frame.ids may change in number and value;
  /// atoms keep their ids. In all other files every frame has the atoms of the first.
  /// @throws FileError if the file is broken or ends inside a frame, if a coordinate is not finite or larger
  /// than
  ///   kMaxCoordinate, if the box has a zero or negative extent, if an id occurs twice in a frame, or if the
  ///   number of atoms changes in a file without ids. Reading on after a throw is not possible.
  virtual bool read(Frame& frame) = 0;

  virtual std::string format() const = 0;  ///< "LAMMPS dump", "GROMACS XTC", "DCD", "H5MD", ...
  virtual std::string length_unit()
      const = 0;  ///< "nm", "Angstrom", "the dump's unit", or what the file says
};

/// What a small file may grow to in memory.
struct ReadLimits {
  /// A compressed file may expand to so many bytes within one frame (a topology: in all). Other files need no
  /// bound, since a frame takes a fixed multiple of its bytes in the file.
  std::int64_t expanded = std::int64_t{4} << 30;
};

/// Opens a trajectory by its file name: .lammpstrj .dump .lammpstrj.gz .dump.gz (LAMMPS text dump), .xtc .trr
/// .gro (GROMACS), .dcd (CHARMM/NAMD), .h5 .h5md (H5MD).
/// @throws FileError if the file does not exist, cannot be read, is empty, or its ending is unknown (the
/// message lists
///   those known).
std::unique_ptr<TrajectoryReader> open_trajectory(const std::string& path, const ReadLimits& limits = {});

/// Opens a trajectory whose name does not tell its format.
/// @param format one of trajectory_formats(); empty: by the file name
/// @throws FileError as above.
std::unique_ptr<TrajectoryReader> open_trajectory(const std::string& path, const std::string& format,
                                                  const ReadLimits& limits = {});

/// The formats that can be read: the endings of names above, without the dot.
std::vector<std::string> trajectory_formats();

}  // namespace dch::trajectory
