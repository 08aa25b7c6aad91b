// SPDX-License-Identifier: MIT
#include <string>

#include <dch/trajectory/writer.hpp>

#include "base/place.hpp"
#include "files/file_name.hpp"
#include "h5md/h5md_writer.hpp"
#include "lammps/lammps_dump_writer.hpp"

namespace dch::trajectory {

std::unique_ptr<TrajectoryWriter> create_trajectory(const std::string& path, const std::string& length_unit) {
  const std::string name = lower_case_name(path);
  if (has_ending(name, ".h5") || has_ending(name, ".h5md"))
    return std::make_unique<H5mdWriter>(path, length_unit);
  if (has_ending(name, ".lammpstrj") || has_ending(name, ".dump")) {
    return std::make_unique<LammpsDumpWriter>(path, length_unit);
  }
  fail(path, "unknown kind of trajectory to write; the endings known are .h5 .h5md .lammpstrj .dump");
}

}  // namespace dch::trajectory
