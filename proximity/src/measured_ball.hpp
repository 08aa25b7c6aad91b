// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/proximity/point_tree.hpp>

namespace dch::detail {

/// Points below a node of a tree, at least one.
struct PointsOfNode {
  Span<const Vec3> at;  ///< wrapped
  Span<const std::int32_t> ids;
};

/// Sets center, radius, reach and representative of a node: a ball around the middle of its points.
void measure_ball(const Box& box, PointsOfNode points, PointTree::Node& node);
/// The same, but around the center that the node has if that ball is smaller.
void measure_ball_again(const Box& box, PointsOfNode points, PointTree::Node& node);

}  // namespace dch::detail
