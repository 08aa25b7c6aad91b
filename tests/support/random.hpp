// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <dch/base/vec3.hpp>

namespace dch::scenes {

/// Random numbers that are the same with every standard library: the engine is specified by the standard, its
/// distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in {0, ..., count - 1}; count > 0.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }

  /// A vector of any type, uniform in the cube [low, high)^3; z is drawn first.
  template <class Vector>
  Vector vector(double low, double high) {
    const double z = uniform(low, high), y = uniform(low, high), x = uniform(low, high);
    return Vector(x, y, z);
  }
  /// Uniform in the cube [-half_side, half_side)^3.
  Vec3 in_cube(double half_side) {
    const double x = uniform(-half_side, half_side), y = uniform(-half_side, half_side);
    return {x, y, uniform(-half_side, half_side)};
  }
  /// Uniform in the ball of the given radius.
  Vec3 in_ball(double radius) {
    for (;;) {
      const Vec3 p = in_cube(1);
      if (norm2(p) <= 1) return radius * p;
    }
  }

  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t k = items.size(); k > 1; --k) std::swap(items[k - 1], items[below(k)]);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace dch::scenes
