// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace dch::trajectory::test {

/// A frame as libgromacs has it: single precision.
struct GromacsFrame {
  std::int64_t step = 0;
  float time = 0;
  bool has_box = true;
  std::array<std::array<float, 3>, 3> box{};
  std::vector<std::array<float, 3>> positions;
  float precision = 1000;  ///< of XTC [1/nm]
  bool has_velocities = false;
};

/// Writes .xtc or .trr by libgromacs. @throws std::runtime_error.
void write_by_gromacs(const std::string& path, const std::vector<GromacsFrame>& frames);

/// Reads .xtc, .trr or .gro by libgromacs: frames with positions. The file must be a good one.
std::vector<GromacsFrame> read_by_gromacs(const std::string& path);

/// Reads the file and throws the frames away; returns how many there were.
std::size_t skim_by_gromacs(const std::string& path);

}  // namespace dch::trajectory::test
