// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/necklace/necklace.hpp>

namespace dch::necklace::detail {

/// Refuses positions that no structure over the beads can work with; those of particles in no chain are not
/// looked at. Returns the largest magnitude of a coordinate.
/// @throws InvalidParameter for another number of positions than particles, InvalidPosition.
double check_positions(const Necklace& necklace, Span<const Vec3> positions);

}  // namespace dch::necklace::detail
