// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

namespace dch::necklace::detail {

/// Two segments of rings over each other in a projection.
struct Overlap {
  std::size_t a = 0, b = 0;   ///< segments, by their first corners
  double on_a = 0, on_b = 0;  ///< where along them, 0 .. 1
  double error = 0;           ///< of these
  bool a_is_over = false;
  int sign =
      0;  ///< of the crossing: +1 where the upper turns counterclockwise into the direction of the lower
};

/// Closed polygons seen along one of some directions that are as good as random. Signs are certain, or none
/// is given.
class Projection {
 public:
  static constexpr int kDirections = 32;

  explicit Projection(int direction);

  /// All overlaps of two rings, or nothing if a sign is uncertain.
  std::optional<std::vector<Overlap>> overlaps(Span<const Vec3> a, Span<const Vec3> b) const;
  /// All overlaps of a ring with itself, a < b.
  std::optional<std::vector<Overlap>> overlaps(Span<const Vec3> ring) const;

 private:
  std::vector<Vec3> seen(Span<const Vec3> ring) const;

  Vec3 x_, y_, z_;
};

/// @throws InvalidParameter, InvalidPosition
void check_ring(Span<const Vec3> ring);
/// A message for RingsTouch.
std::string no_projection(const char* what);

}  // namespace dch::necklace::detail
