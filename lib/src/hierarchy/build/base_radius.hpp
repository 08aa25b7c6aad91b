// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

namespace dch::detail {

/// R_0 for which level 1 has leaves of a size that lists are made fast with, as measured on a few of the
/// points: a median, so that it follows where most points are, not how large the box is. O(n) time.
/// @param radius of the lists; the result is within a factor of it.
double base_radius_for(Span<const Vec3> positions, const Box& box, double radius);
/// Distances that this computes for so many points.
std::int64_t density_samples(std::size_t points);

}  // namespace dch::detail
