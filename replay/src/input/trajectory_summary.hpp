// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dch::cli {

/// What reports say of the trajectory itself.
struct TrajectorySummary {
  std::string file, format;
  std::string unit;                ///< of length
  std::int64_t frames_passed = 0;  ///< read, selected or not; all the file's frames if the range is unbounded
  std::int64_t fewest_atoms = 0, most_atoms = 0;  ///< in a frame
  std::vector<std::string> box_kinds;             ///< Box::description() in order of appearance, each once
  double smallest_height = 0;  ///< over the selected frames [length]; infinity without a periodic box
  std::int64_t smallest_height_frame = 0;  ///< the first frame with it
};

/// The unit of length as it follows a number: "nm", but "[the dump's unit]".
std::string unit_suffix(const std::string& unit);
/// The kinds of box, and the smallest height if it is finite.
std::string box_text(const TrajectorySummary& summary);

}  // namespace dch::cli
