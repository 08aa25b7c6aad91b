// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <dch/geometry/box.hpp>

namespace dch::detail {

/// The lattice vectors whose images of charges count in a screened sum, 0 first: so many that those left out
/// contribute at most `share` of the sum over absolute charges, to any point.
/// @param extent two points are at most this far apart in one image [length]
/// @throws InvalidParameter if kappa is so small that there are too many, or 0 in a periodic box.
std::vector<Vec3> sum_images(const Box& box, double kappa, double extent, double share);

}  // namespace dch::detail
