// SPDX-License-Identifier: MIT
#include "crossing/projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/geometry/box.hpp>

#include "crossing/pair_motion.hpp"

namespace dch::necklace::detail {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// -1, 0 (uncertain) or 1
int sign(double value, double error) { return value > error ? 1 : value < -error ? -1 : 0; }

double turn(Vec3 a, Vec3 b) { return a.x * b.y - a.y * b.x; }

enum class Verdict { apart, over, uncertain };

/// Of segments in coordinates that are off by up to `error` each.
Verdict overlap_of(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1, double error, Overlap& out) {
  if (std::max(a0.x, a1.x) + 2 * error < std::min(b0.x, b1.x) ||
      std::max(b0.x, b1.x) + 2 * error < std::min(a0.x, a1.x) ||
      std::max(a0.y, a1.y) + 2 * error < std::min(b0.y, b1.y) ||
      std::max(b0.y, b1.y) + 2 * error < std::min(a0.y, a1.y))
    return Verdict::apart;
  const Vec3 a = a1 - a0, b = b1 - b0, between = b0 - a0;
  const double size =
      std::max({largest(a), largest(b), largest(b1 - a0), largest(a1 - b0), largest(between)});
  // Differences are off by 2 error and a rounding; turns have two products of these, the volume six of three.
  const double off = 2 * error + kEpsilon * size;
  const double turn_error = 8 * (off * (size + off) + kEpsilon * size * size);
  const double volume_error = 32 * (off * (size + off) * (size + off) + kEpsilon * size * size * size);
  const int b0_side = sign(turn(a, between), turn_error), b1_side = sign(turn(a, b1 - a0), turn_error);
  const int a0_side = sign(-turn(b, between), turn_error), a1_side = sign(turn(b, a1 - b0), turn_error);
  if (b0_side * b1_side > 0 || a0_side * a1_side > 0) return Verdict::apart;
  const int orientation = sign(turn(a, b), turn_error);
  const int volume = sign(dot(cross(a, b), between), volume_error);
  if (b0_side * b1_side * a0_side * a1_side == 0 || orientation == 0 || volume == 0)
    return Verdict::uncertain;
  const double whole = turn(a, b);
  out.on_a = turn(between, b) / whole;
  out.on_b = turn(between, a) / whole;
  out.error = 4 * turn_error / std::abs(whole);
  out.a_is_over = volume != orientation;
  out.sign = out.a_is_over ? orientation : -orientation;
  return Verdict::over;
}

}  // namespace

/// Directions go by the golden angle and its like, so that no lattice is parallel to any.
Projection::Projection(int direction) {
  const double turn_angle = 0.4 + 2.399963229728653 * direction;
  const double height = 1 - 2 * std::fmod(0.3 + 0.6180339887498949 * direction, 1.0);
  const double width = std::sqrt(1 - height * height);
  z_ = {width * std::cos(turn_angle), width * std::sin(turn_angle), height};
  const Vec3 aside = std::abs(z_.z) < 0.7 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 x = cross(aside, z_);
  x_ = (1 / std::sqrt(norm2(x))) * x;
  y_ = cross(z_, x_);
}

std::vector<Vec3> Projection::seen(Span<const Vec3> ring) const {
  std::vector<Vec3> result;
  for (const Vec3 corner : ring) result.push_back({dot(x_, corner), dot(y_, corner), dot(z_, corner)});
  return result;
}

std::optional<std::vector<Overlap>> Projection::overlaps(Span<const Vec3> a, Span<const Vec3> b) const {
  double magnitude = 0;
  for (const Vec3 corner : a) magnitude = std::max(magnitude, largest(corner));
  for (const Vec3 corner : b) magnitude = std::max(magnitude, largest(corner));
  // Five roundings of numbers of up to 3 magnitudes. The map itself is taken as the matrix of doubles that it
  // is: any that keeps orientation will do.
  const double error = 8 * kEpsilon * magnitude;
  const std::vector<Vec3> seen_a = seen(a), seen_b = seen(b);
  std::vector<Overlap> found;
  for (std::size_t i = 0; i < seen_a.size(); ++i) {
    const Vec3 a0 = seen_a[i], a1 = seen_a[(i + 1) % seen_a.size()];
    for (std::size_t j = 0; j < seen_b.size(); ++j) {
      Overlap overlap;
      const Verdict verdict = overlap_of(a0, a1, seen_b[j], seen_b[(j + 1) % seen_b.size()], error, overlap);
      if (verdict == Verdict::uncertain) return std::nullopt;
      if (verdict == Verdict::apart) continue;
      overlap.a = i;
      overlap.b = j;
      found.push_back(overlap);
    }
  }
  return found;
}

std::optional<std::vector<Overlap>> Projection::overlaps(Span<const Vec3> ring) const {
  double magnitude = 0;
  for (const Vec3 corner : ring) magnitude = std::max(magnitude, largest(corner));
  const double error = 8 * kEpsilon * magnitude;
  const std::vector<Vec3> seen_ring = seen(ring);
  const std::size_t n = ring.size();
  std::vector<Overlap> found;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbors, as i and i + 1 are
      Overlap overlap;
      const Verdict verdict =
          overlap_of(seen_ring[i], seen_ring[i + 1], seen_ring[j], seen_ring[(j + 1) % n], error, overlap);
      if (verdict == Verdict::uncertain) return std::nullopt;
      if (verdict == Verdict::apart) continue;
      overlap.a = i;
      overlap.b = j;
      found.push_back(overlap);
    }
  }
  return found;
}

void check_ring(Span<const Vec3> ring) {
  if (ring.size() < 3) {
    throw InvalidParameter("a ring has " + std::to_string(ring.size()) + " corners; it needs three at least");
  }
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto is_fine = [](double x) { return std::abs(x) <= kMaxCoordinate; };  // NaN is not
    if (!is_fine(ring[k].x) || !is_fine(ring[k].y) || !is_fine(ring[k].z)) {
      throw InvalidPosition("corner " + std::to_string(k) +
                            " of a ring has a coordinate that is not finite or beyond 1e100");
    }
  }
}

std::string no_projection(const char* what) {
  return std::string(what) + " in all " + std::to_string(Projection::kDirections) +
         " projections; move the beads that meet apart";
}

}  // namespace dch::necklace::detail
