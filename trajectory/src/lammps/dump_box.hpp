// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "files/line_reader.hpp"
#include "frames/cell.hpp"

namespace dch::trajectory {

/// Reads the three lines below "ITEM: BOX BOUNDS <text>".
///
/// The text holds boundary letters ("pp pp ff", all periodic if missing as in files of old), before them "xy
/// xz yz" for a triclinic box, whose lines hold the bounds of its bounding box and the tilts, or "abc origin"
/// for a general one.
/// @throws FileError for unknown labels and lines that are not numbers or too few or too many.
Cell read_dump_cell(LineReader& lines, std::string_view text);

}  // namespace dch::trajectory
