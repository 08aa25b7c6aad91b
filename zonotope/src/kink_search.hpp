// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>

namespace dch::zonotope {

/// A term |a x + b y + c|, with its kink along the line a x + b y + c = 0.
struct KinkLine {
  double a = 0, b = 0, c = 0;
};

/// Where a sum of such terms is least, and what it took.
struct KinkMinimum {
  double x = 0, y = 0;
  std::size_t line = 0;         ///< a line through this point; of no meaning if all a and b are 0
  int rounds = 0;               ///< vertical lines that were looked at
  std::int64_t operations = 0;  ///< comparisons, and terms that were evaluated
};

/// A point where sum |a x + b y + c| is least: a vertex of the arrangement of the lines. Binary search over
/// the vertices by x: a vertical line through a random one of those left is looked at, the minimum on it
/// tells on which side the minimum of all is, by the slope from there along the line that goes through it
/// (thesis 3.4.1: Lemmas 3.4.1 to 3.4.4, Theorem 3.4.5; thesis 3.5.1: Theorem 3.5.2, where the vertical line
/// is the dual of a separator of the tiling). The random vertex takes the place of slope selection (J.
/// Matousek, Inf. Process. Lett. 39:183, 1991): vertices between two vertical lines are inversions of the
/// orders of the lines along them. Expected O(log n) rounds of O(n log n).
///
/// Parallel lines, lines through one point and vertical ones are allowed; the plane is turned so that none is
/// vertical. In doubles: where rounding hides the order of vertices, a neighbor of the minimum may come out.
/// @param seed of the random vertices
KinkMinimum least_kinks(Span<const KinkLine> lines, std::uint64_t seed = 1);

}  // namespace dch::zonotope
