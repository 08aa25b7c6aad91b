// SPDX-License-Identifier: MIT
#include "frames/frame_check.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "base/place.hpp"
#include "frames/cell.hpp"

namespace dch::trajectory {

void check_frame(const Frame& frame, const std::string& path, std::int64_t frame_number) {
  const std::size_t n = frame.positions.size();
  const auto check_size = [&](std::size_t size, bool may_be_empty, const char* what) {
    if (size == n || (may_be_empty && size == 0)) return;
    fail(path, fmt::format("frame {} cannot be written: it has {} positions but {} {}", frame_number, n, size,
                           what));
  };
  check_size(frame.ids.size(), false, "ids");
  check_size(frame.types.size(), true, "types");
  check_size(frame.molecules.size(), true, "molecule numbers");
  check_size(frame.images.size(), true, "images");
  const auto bad = std::find_if_not(frame.positions.begin(), frame.positions.end(), is_valid_position);
  if (bad == frame.positions.end()) return;
  fail(path,
       fmt::format("frame {} cannot be written: the atom with id {} has a coordinate that is not finite",
                   frame_number, frame.ids[static_cast<std::size_t>(bad - frame.positions.begin())]));
}

}  // namespace dch::trajectory
