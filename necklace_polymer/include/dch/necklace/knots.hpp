// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/error.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// A ring touches itself or another, or comes so near to it that doubles do not tell the two apart in any
/// projection tried: what is asked for has no value, or none that is certain.
class RingsTouch : public Error {
 public:
  using Error::Error;
};

// Rings are closed polygons: their corners in order, the last one joined to the first, all in one image (see
// unwrap()).

/// The linking number of two rings: how often one winds around the other, an integer that no motion changes
/// in which the rings do not go through each other. Gauss's sign: (r_a - r_b) . (dr_a x dr_b) > 0 counts up,
/// so it is half the sum of the signs of the crossings in any projection.
///
/// **Exact**: the signs of one projection are taken where all are beyond bounds on their errors, else those
/// of another. In a periodic box it is that of the images given; sum over images of one of them that reach
/// the other for that of a ring with all copies. O(n m).
/// @throws InvalidParameter for a ring of fewer than three corners, InvalidPosition for a coordinate that is
/// not
///   finite or larger than kMaxCoordinate, RingsTouch.
std::int64_t linking_number(Span<const Vec3> a, Span<const Vec3> b);

/// The writhe of a ring: Gauss's double integral of the ring with itself over 4 pi, or the sum of the signs
/// of the crossings in a projection averaged over all directions. It is no integer, and changes by 2 where
/// the ring goes through itself. A sum of solid angles of all pairs of segments, to within rounding: some
/// 1e-15 a pair, and more for segments that all but touch. O(n^2).
/// @throws InvalidParameter and InvalidPosition as linking_number().
double writhe(Span<const Vec3> ring);

/// The determinant of a knot, which is the magnitude of its Alexander polynomial at -1: 1 for an unknotted
/// ring, 3 for the trefoil T(2, 3), 5 for T(2, 5), 3 for T(3, 4). No motion changes it in which the ring does
/// not go through itself. A ring with another value than 1 is knotted; some knots have 1.
///
/// **Exact**: signs of a projection as for linking_number(); the determinant of a minor of the coloring
/// matrix of its c crossings modulo as many primes as Hadamard's bound asks for. O(n^2 + c^4).
/// @throws InvalidParameter and InvalidPosition as linking_number(), RingsTouch, and InvalidParameter for a
///   determinant above 2^60.
std::int64_t knot_determinant(Span<const Vec3> ring);

}  // namespace dch::necklace
#pragma GCC visibility pop
