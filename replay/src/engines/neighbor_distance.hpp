// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

namespace dch::cli {

/// About how far the k-th nearest of other points is: the median of that distance around a few of the points,
/// which tells for what radius a hierarchy should be made [length]. The same at every call. O(n).
/// @return 0 for fewer than two points, and where most points coincide with k others
double neighbor_distance(Span<const Vec3> positions, const Box& box, std::int32_t k);

}  // namespace dch::cli
