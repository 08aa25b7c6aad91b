// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <dch/geometry/box.hpp>

namespace dch::cli {

/// Hard spheres at a time, as `dchmd hardspheres --restart` writes them: docs/formats.md.
struct SphereState {
  double time = 0;
  double edge = 0;            ///< of the cubic periodic box, one corner of which is the origin [length]
  std::vector<double> radii;  ///< [length]
  std::vector<double> masses;
  std::vector<Vec3> positions, velocities;

  Box box() const { return Box::orthorhombic({edge, edge, edge}); }
};

/// The text of the file; numbers in it read back as the same doubles.
std::string render_state(const SphereState& state);

/// @throws trajectory::FileError for a file that cannot be read, is no such file or is broken.
SphereState read_state(const std::string& path);

}  // namespace dch::cli
