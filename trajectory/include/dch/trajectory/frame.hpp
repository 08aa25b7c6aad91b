// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

namespace dch::trajectory {

/// One frame of a trajectory. Lengths are in the file's own unit (see TrajectoryReader::length_unit).
///
/// Atoms are in ascending order of their id; files without ids keep their own order and get ids 1, 2, ... .
struct Frame {
  std::int64_t step = 0;       ///< the file's time step number, or the frame's index where it has none
  std::optional<double> time;  ///< [ps]; in the file's own unit where that is not known (reduced units)
  Box box;
  std::vector<Vec3> positions;          ///< n, as stored (not wrapped; scaled coordinates are unscaled)
  std::vector<std::int64_t> ids;        ///< n
  std::vector<std::int32_t> types;      ///< n or empty; the file's own numbers
  std::vector<std::int32_t> molecules;  ///< n or empty; the file's own numbers
  std::vector<std::array<std::int32_t, 3>> images;  ///< n or empty; box images (LAMMPS ix iy iz)
};

}  // namespace dch::trajectory
