// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "files/input_file.hpp"

namespace dch::trajectory {

/// What stands in front of the frames of a DCD file (CHARMM, NAMD, X-PLOR).
struct DcdHeader {
  std::endian order = std::endian::little;
  std::int64_t atoms = 0;
  std::int64_t first_step = 0;
  std::int64_t step_interval = 0;
  double time_step = 0;  ///< [ps]
  bool has_cell = false;
  bool has_fourth_dimension = false;
  std::vector<std::int32_t> free_atoms;  ///< indices of the atoms in frames 1, 2, ...; empty if all are
  std::int64_t size = 0;                 ///< offset of the first frame [bytes]
};

/// @throws FileError if the file does not begin with a DCD header, or ends inside it.
DcdHeader read_dcd_header(const InputFile& file);

}  // namespace dch::trajectory
