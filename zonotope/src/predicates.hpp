// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/zonotope/vec2.hpp>

namespace dch::zonotope {

/// Below this a product may have lost digits to underflow, and the sign of a double is not trusted.
constexpr double kSmallest = 1e-290;
constexpr double kRounding = 0x1p-53;

/// The signs of a x b and of det(a, b, c), without rounding: doubles where their error bound allows, else
/// Exact.
int sign_of_cross(Vec2 a, Vec2 b);
int sign_of_det(Vec3 a, Vec3 b, Vec3 c);
/// Of the area (b - a) x (c - a): positive if c is to the left of the way from a to b.
int orientation(Vec2 a, Vec2 b, Vec2 c);

/// Whether three of the vectors are independent, without rounding. O(n).
bool span_space(const std::vector<Vec3>& vectors);

/// Whether a x b = 0, without rounding.
bool are_parallel(Vec3 a, Vec3 b);

}  // namespace dch::zonotope
