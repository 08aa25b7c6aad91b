// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <dch/base/index_count.hpp>
#include <dch/necklace/shapes.hpp>

#include "chains/parameter_check.hpp"

namespace dch::necklace {

using detail::require_parameter;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// The point of a torus knot at t in [0, 1], on a torus of radii 2 and 1.
Vec3 knot_point(double p, double q, double t) {
  const double around = 2 * kPi * p * t, through = 2 * kPi * q * t;
  const double distance = 2 + std::cos(through);
  return {distance * std::cos(around), distance * std::sin(around), std::sin(through)};
}

/// k, or the same counted from the other end on odd rows.
std::int32_t there_and_back(std::int32_t k, std::int32_t count, std::int32_t row) {
  return row % 2 == 0 ? k : count - 1 - k;
}

/// One segment of facing_bumps(), from (0, 0) to (2n, 0).
std::vector<Vec3> bumps(std::int32_t n, std::int32_t c) {
  std::vector<Vec3> beads{{0, 0, 0}};
  for (std::int32_t bump = 0; bump < n / c; ++bump) {
    const double x = 2.0 * c * bump;
    for (std::int32_t k = 1; k <= c; ++k) beads.push_back({x, double(k), 0});
    for (std::int32_t k = c; k >= 1; --k) beads.push_back({x + 1, double(k), 0});
    for (std::int32_t k = 1; k <= 2 * c; ++k) beads.push_back({x + k, 0, 0});
  }
  return beads;
}

}  // namespace

Necklace necklace_of(const Shape& shape, double radius) {
  return Necklace::chain(std::vector<double>(shape.positions.size(), radius), shape.closed);
}

Shape grid_necklace(std::int32_t nx, std::int32_t ny, std::int32_t nz) {
  const double beads = double(nx) * double(ny) * double(nz);
  require_parameter(nx >= 1 && ny >= 1 && nz >= 1 && beads <= std::numeric_limits<std::int32_t>::max(),
                    "the grid is " + std::to_string(nx) + " x " + std::to_string(ny) + " x " +
                        std::to_string(nz) + "; sides have to be 1 or more, their product at most 2^31 - 1");
  Shape shape;
  shape.positions.reserve(static_cast<std::size_t>(beads));
  for (std::int32_t z = 0; z < nz; ++z) {
    for (std::int32_t row = 0; row < ny; ++row) {
      const std::int32_t y = there_and_back(row, ny, z);
      for (std::int32_t k = 0; k < nx; ++k) {
        const std::int32_t x = there_and_back(k, nx, z * ny + row);
        shape.positions.push_back({double(x), double(y), double(z)});
      }
    }
  }
  return shape;
}

Shape helix(std::int32_t beads, double radius, double angle, double rise) {
  require_parameter(beads >= 0 && std::isfinite(radius) && std::isfinite(angle) && std::isfinite(rise),
                    "a helix of " + std::to_string(beads) + " beads, radius " + std::to_string(radius) +
                        ", angle " + std::to_string(angle) + " and rise " + std::to_string(rise) +
                        ": all have to be finite, and beads >= 0");
  Shape shape;
  for (std::int32_t k = 0; k < beads; ++k) {
    shape.positions.push_back({radius * std::cos(angle * k), radius * std::sin(angle * k), rise * k});
  }
  return shape;
}

Shape torus_knot(std::int32_t p, std::int32_t q, std::int32_t beads) {
  require_parameter(p >= 1 && q >= 1 && std::gcd(p, q) == 1,
                    "T(" + std::to_string(p) + ", " + std::to_string(q) +
                        ") is no knot; both have to be 1 or more and have no common divisor");
  require_parameter(beads >= 3, "a knot of " + std::to_string(beads) + " beads; it needs 3 or more");
  // Beads stand at equal lengths along a polygon fine enough to follow the curve.
  const std::int32_t corners = index_count(32 * std::max<std::int64_t>(beads, std::int64_t{p} + q),
                                           "corners of the knot", "take fewer beads");
  std::vector<double> length{0};
  for (std::int32_t k = 1; k <= corners; ++k) {
    const Vec3 step = knot_point(p, q, double(k) / corners) - knot_point(p, q, double(k - 1) / corners);
    length.push_back(length.back() + std::sqrt(norm2(step)));
  }
  Shape shape;
  shape.closed = true;
  const double scale = beads / length.back();
  for (std::int32_t bead = 0; bead < beads; ++bead) {
    const double at = bead / scale;
    const auto after = std::upper_bound(length.begin(), length.end(), at);
    const double before = *(after - 1);
    const double corner = static_cast<double>(after - 1 - length.begin()) + (at - before) / (*after - before);
    shape.positions.push_back(scale * knot_point(p, q, corner / corners));
  }
  return shape;
}

Shape facing_bumps(std::int32_t n, std::int32_t c, double gap, double progress) {
  require_parameter(c >= 1 && n <= 100'000'000 && c <= n / 4 && n % c == 0 && n >= 4 * c + 2,
                    std::to_string(n) + " beads in bumps of height " + std::to_string(c) +
                        "; the height has to be 1 or more and divide n, and n be in 4 c + 2 .. 10^8");
  require_parameter(gap > 0 && gap <= 1, "the gap is " + std::to_string(gap) + "; it has to be in (0, 1]");
  require_parameter(progress >= 0 && progress <= 1,
                    "progress is " + std::to_string(progress) + "; it has to be in 0 .. 1");
  const std::vector<Vec3> lower = bumps(n, c);
  Shape shape{lower, false};
  const double height = 2.0 * c + gap;
  const double right = 2.0 * n;                     // where the lower segment ends
  const double end = 3.0 * n - 2.0 * n * progress;  // where the upper one does
  // The bent segment goes to the right, up a half circle, and back; it takes 2n + 1 bonds.
  const double arc = kPi * height / 2;
  const double straight = (2.0 * n + 1 - arc - (right - end)) / 2;
  const double turn = right + straight;
  for (std::int32_t k = 1; k <= 2 * n; ++k) {
    const double s = k;
    if (s < straight) {
      shape.positions.push_back({right + s, 0, 0});
    } else if (s < straight + arc) {
      const double angle = (s - straight) / (height / 2);
      shape.positions.push_back({turn + height / 2 * std::sin(angle), height / 2 * (1 - std::cos(angle)), 0});
    } else {
      shape.positions.push_back({turn - (s - straight - arc), height, 0});
    }
  }
  for (std::size_t k = lower.size(); k-- > 0;) {
    shape.positions.push_back({lower[k].x - right + end, height - lower[k].y, 0});
  }
  return shape;
}

Shape tight_set(std::int32_t k) {
  require_parameter(k >= 0 && k <= 24, "k is " + std::to_string(k) + "; it has to be in 0 .. 24");
  Shape shape{{{1, 0, 0}}, false};
  double angle = 0;  // direction of O_l from O
  for (std::int32_t level = 0; level < k; ++level) {
    const double here = std::sqrt(1 - double(level) / k), next = std::sqrt(1 - double(level + 1) / k);
    // The right angle is at O_{l+1}; with O_k = O this gives the perpendicular.
    angle += level + 1 < k ? std::acos(next / here) : kPi / 2;
    const Vec3 axis{std::cos(angle), std::sin(angle), 0};
    const std::size_t half = shape.positions.size();
    for (std::size_t j = 0; j < half; ++j) {
      const Vec3 p = shape.positions[j];
      shape.positions.push_back(2 * dot(p, axis) * axis - p);
    }
  }
  return shape;
}

}  // namespace dch::necklace
