// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

namespace dch::detail {

/// Indices of the points along a Morton curve over cells of the given width [length], ties in index order.
///
/// Only locality depends on it, never a result. Cells are numbered modulo 2^21 along each axis, so that a
/// single far point does not cost the others their resolution, as scaling to the bounding box would.
std::vector<std::int32_t> space_filling_order(Span<const Vec3> positions, const Box& box, double width);

}  // namespace dch::detail
