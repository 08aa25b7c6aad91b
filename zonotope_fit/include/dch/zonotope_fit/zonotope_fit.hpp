// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/zonotope/zonogon.hpp>
#include <dch/zonotope/zonotope.hpp>

namespace dch::zonotope {

/// A point or a direction in a space of any dimension.
using Coordinates = std::vector<double>;

/// A zonotope whose generators are lengths[k] directions[k], and what it took.
struct FittedZonotope {
  Coordinates center;                   ///< [length]
  std::vector<Coordinates> directions;  ///< unit vectors
  std::vector<double> lengths;          ///< >= 0, of the half edges [length]
  double total_length = 0;              ///< their sum, which is what is least [length]
  std::int64_t normals = 0;             ///< of facets that any lengths can give: pairs of constraints
  std::int64_t rows = 0;                ///< constraints that were handed to the solver
  int programs = 0;                     ///< linear programs that were solved
};

/// The zonotope of least total length that has generators along given directions and holds all points
/// (thesis 3.4.2, Theorem 3.4.6), in d >= 1 dimensions.
///
/// The program is in support form: the unknowns are the k lengths c and the center p, k + d in all, where the
/// text's has k coefficients for each extreme point. For each normal n of the arrangement of the directions,
/// that is of each d - 1 of them, and for its opposite: n . p + sum c_i |n . v_i| >= max n . p_j. These
/// suffice: in a cell of the arrangement the left side is linear, the right side convex. Rows are handed to
/// CLP as they are violated. Cost O(n k^(d-1)) for the extreme points, and O(k^d) to look for violated rows,
/// times the number of programs.
///
/// All points are in the zonotope but for rounding: the lengths are enlarged by what the solver's tolerance
/// left, so that along each normal it reaches as far as the points to 1e-13 of their extent; the total is
/// then within 1e-7 of the least. Directions may be parallel and need not span space.
/// @throws InvalidParameter if there are no points, points or directions differ in dimension, one is not
/// finite, a direction
///   is 0, there are more than 1e7 normals, or a point is not in the space that the directions span, through
///   the first point (beyond 1e-9 of the extent); Error if the solver fails
FittedZonotope oriented_zonotope(const std::vector<Coordinates>& points,
                                 const std::vector<Coordinates>& directions);

/// Unit vectors such that each direction, or its opposite, is within `distance` of one of them: the centers
/// of cells on the faces of a cube, d m^(d-1) of them with m the least integer that is at least sqrt(d - 1) /
/// distance.
std::vector<Coordinates> direction_grid(int dimension, double distance);

/// A zonotope that holds all points, with a total length of at most (1 + epsilon) times the least of all
/// zonotopes that do (thesis 3.4.3, Theorem 3.4.7; in its proof D is a sum over all r generators, and the box
/// has the generators e_i): that of oriented_zonotope() for direction_grid(d, epsilon / d) and the axes. With
/// epsilon = 1, 0.5, 0.25 that is 78, 246 and 870 directions in space: normals rise with 1 / epsilon^4.
/// @param epsilon within 0.05..2
/// @throws as oriented_zonotope()
FittedZonotope least_length_zonotope(const std::vector<Coordinates>& points, double epsilon);

/// The same in space or in the plane, without generators of length 0.
/// @throws InvalidParameter for another dimension
Zonotope in_space(const FittedZonotope& fitted);
Zonogon in_plane(const FittedZonotope& fitted);

}  // namespace dch::zonotope
