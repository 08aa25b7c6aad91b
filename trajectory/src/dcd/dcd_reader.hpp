// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <dch/trajectory/reader.hpp>

#include "dcd/dcd_header.hpp"
#include "files/input_file.hpp"
#include "files/record_file.hpp"
#include "frames/cell.hpp"

namespace dch::trajectory {

/// DCD files of CHARMM, NAMD and X-PLOR in either byte order, with fixed atoms and a fourth dimension (passed
/// over).
///
/// The number of frames comes from the size of the file, since programs leave the header's number 0 or wrong.
class DcdReader final : public TrajectoryReader {
 public:
  /// @throws FileError as open_trajectory, and for a broken header.
  explicit DcdReader(const std::string& path);

  bool read(Frame& frame) override;
  std::string format() const override { return "DCD"; }
  std::string length_unit() const override { return "Angstrom"; }

 private:
  void read_cell(Frame& frame);
  void read_coordinate(int axis, Frame& frame);

  InputFile file_;
  DcdHeader header_;
  RecordFile records_;
  std::vector<Vec3> first_positions_;  ///< of frame 0, if there are fixed atoms
  std::int64_t frames_ = 0;
};

}  // namespace dch::trajectory
