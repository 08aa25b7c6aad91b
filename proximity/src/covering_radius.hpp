// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/proximity/point_tree.hpp>

namespace dch::detail {

/// The squared distance of the farthest point of a tree from the nearest of some of its points [length^2].
/// Subtrees are left out whose points are all nearer than one that was found, and centers that another one is
/// surely nearer than.
/// @param looked_at counts distances of centers from nodes
double covering_radius2(const PointTree& tree, Span<const std::int32_t> centers, std::int64_t& looked_at);

}  // namespace dch::detail
