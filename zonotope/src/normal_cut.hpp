// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>

namespace dch::zonotope {

/// A stretch of normals start + t along, and the generators whose lines n . u = 0 cross it, in order.
struct NormalCut {
  struct Crossing {
    double t;
    std::size_t generator;
    Vec3 gradient;  ///< of h between this crossing and the next
  };
  Vec3 start, along;
  double from = 0, to = 1;  ///< of t; infinite for a whole line
  Vec3 gradient;            ///< of h before the first crossing
  std::vector<Crossing> crossings;

  /// Where (n . x) / h(n) is largest among the n with n . x > 0.
  struct Best {
    enum class Place { nowhere, start, end, crossing } place = Place::nowhere;
    std::size_t crossing = 0;
    double t = 0;
    Vec3 gradient;  ///< without the generator that crosses there
  };
  /// @param generators with the signs that gradients are made of: n . u is positive after the crossing if
  /// dot(along, u) is
  Best best_for(Vec3 x, const std::vector<Vec3>& generators, std::int64_t& operations) const;
};

}  // namespace dch::zonotope
