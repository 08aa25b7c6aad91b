// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include <dch/lists/neighbor_list.hpp>

#include "engines/viewed_hierarchy.hpp"

namespace dch::cli {

/// Where the positions of a frame are: an axis-parallel box around all of them [length].
struct ViewedExtent {
  Vec3 low{}, high{};
};
ViewedExtent extent_of(const ViewedFrame& frame);

/// The numbers of a frame as ViewPage describes them, deflated, in base64.
std::string view_stream(const ViewedFrame& frame, const ViewedExtent& extent);

}  // namespace dch::cli
