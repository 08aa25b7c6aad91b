// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include <dch/trajectory/frame.hpp>

namespace dch::trajectory {

/// What every writer demands of a frame: arrays of one length, finite coordinates.
/// @throws FileError naming the path and the frame.
void check_frame(const Frame& frame, const std::string& path, std::int64_t frame_number);

}  // namespace dch::trajectory
