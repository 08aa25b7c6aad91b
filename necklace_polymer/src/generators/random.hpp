// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include <dch/base/vec3.hpp>

namespace dch::necklace::detail {

/// Random numbers whose bits do not depend on the platform: the standard fixes std::mt19937_64 but not what
/// its distributions do with it, and sine and cosine differ between mathematics libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  /// Uniform on the unit sphere (Marsaglia, Ann. Math. Stat. 43:645, 1972).
  Vec3 direction() {
    for (;;) {
      const double u = 2 * uniform() - 1;
      const double v = 2 * uniform() - 1;
      const double s = u * u + v * v;
      if (s >= 1) continue;
      const double radius = 2 * std::sqrt(1 - s);
      return {u * radius, v * radius, 1 - 2 * s};
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace dch::necklace::detail
