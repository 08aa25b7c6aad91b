// SPDX-License-Identifier: MIT
#pragma once

namespace dch::detail {

/// Candidate radii (never decisions) are inflated by this factor, squared radii by its square, so that
/// rounding in the triangle inequality cannot hide a node.
inline constexpr double kInflate = 1 + 1e-12;

}  // namespace dch::detail
