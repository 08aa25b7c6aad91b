// SPDX-License-Identifier: MIT
#include "geometry/position_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <dch/base/error.hpp>
#include <dch/base/index_count.hpp>

#include "base/describe.hpp"
#include "geometry/dual_basis.hpp"

namespace dch::detail {
namespace {

double norm(Vec3 v) { return std::sqrt(norm2(v)); }

std::string position_text(std::size_t i, Vec3 p) {
  return "position " + std::to_string(i) + " = " + describe(p);
}

bool in_range(double x) { return std::abs(x) <= kMaxCoordinate; }  // false for NaN

}  // namespace

WrapError::WrapError(const Box& box) : origin_(box.origin()) {
  const int rank = box.rank();
  if (rank == 0) return;
  std::array<Vec3, 3> cell{};
  std::size_t periods = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!box.periodic(axis)) continue;
    const Vec3 v = box.vector(axis);
    cell[periods++] = v;
    cell_size_ += norm(v);
    for (std::size_t k = 0; k < 3; ++k) shifted_[k] = shifted_[k] || v[static_cast<int>(k)] != 0;
  }
  // A shift of length s is a sum of multiples of the cell vectors a_k, each at most s |a_k| / height_k long;
  // products and sums of those round. The reduced vectors are such sums themselves and are multiplied once
  // more in wrapping.
  const auto dual = dual_basis(cell, rank);
  double given = 1, reduced = 1;
  for (std::size_t k = 0; k < periods; ++k) {
    given += norm(cell[k]) * norm(dual[k]);
    reduced += norm(box.reduced()[k]) * norm(box.reduced_dual()[k]);
  }
  constexpr double kRoundings =
      8;  // a bound on their number, given that each of the two sums above is at least 2
  amplification_ = kRoundings * std::numeric_limits<double>::epsilon() * given * reduced;
  // Coordinates themselves are rounded once for each vector and pass, and once where a grid shifts them.
  for (std::size_t k = 0; k < 3; ++k) {
    if (!shifted_[k]) continue;
    coordinate_error_ +=
        kRoundings * std::numeric_limits<double>::epsilon() * std::abs(origin_[static_cast<int>(k)]);
  }
}

double WrapError::reach(Vec3 p) const {
  const Vec3 d = p - origin_;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (shifted_[k]) sum += std::abs(d[static_cast<int>(k)]);
  }
  return sum;
}

double WrapError::reach_within(double error) const {
  return amplification_ > 0 ? (error - coordinate_error_) / amplification_ - cell_size_
                            : std::numeric_limits<double>::infinity();
}

double WrapError::reach_between(Vec3 low, Vec3 high) const {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (shifted_[static_cast<std::size_t>(axis)])
      sum += std::max(std::abs(low[axis] - origin_[axis]), std::abs(high[axis] - origin_[axis]));
  }
  return sum;
}

namespace {

/// The box around positions, and whether all of them are finite.
struct Surroundings {
  explicit Surroundings(Span<const Vec3> positions) : low(positions[0]), high(positions[0]) {
    double differences = 0;  // of a number with itself: 0, but not for infinity and NaN
    for (const Vec3 p : positions) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      differences += (p.x - p.x) + (p.y - p.y) + (p.z - p.z);
    }
    are_finite = differences == 0;
  }
  double largest_coordinate() const { return std::max({-low.x, -low.y, -low.z, high.x, high.y, high.z}); }
  Vec3 low, high;
  bool are_finite;
};

/// Throws for the first position that has something wrong with it, else returns the largest reach.
double check_one_by_one(Span<const Vec3> positions, const WrapError& error, double farthest,
                        double tolerance) {
  double largest = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 p = positions[i];
    if (!(in_range(p.x) && in_range(p.y) && in_range(p.z))) {
      throw InvalidPosition(position_text(i, p) + " is not finite or beyond " + describe(kMaxCoordinate) +
                            "; check the coordinates of this frame");
    }
    const double reach = error.reach(p);
    if (reach > farthest) {
      throw InvalidPosition(
          position_text(i, p) +
          " is so far outside the periodic box that rounding leaves its place there uncertain by " +
          describe(error.bound(reach)) + "; at most " + describe(tolerance) + " is allowed, " +
          (error.bound(0) > tolerance ? "shift the box and the coordinates to the origin"
                                      : "wrap the coordinates first"));
    }
    largest = std::max(largest, reach);
  }
  return largest;
}

}  // namespace

double check_positions(Span<const Vec3> positions, const Box& box) {
  index_count(static_cast<std::int64_t>(positions.size()), "particles", "divide the system");
  const WrapError error(box);
  const double tolerance = box.any_periodic() ? 0.5 * box.min_height() : 1;
  const double farthest = error.reach_within(tolerance);
  if (positions.empty()) return 0;
  const Surroundings around(positions);
  const double largest = error.reach_between(around.low, around.high);
  if (around.are_finite && around.largest_coordinate() <= kMaxCoordinate && largest <= farthest)
    return largest;
  return check_one_by_one(positions, error, farthest, tolerance);
}

void check_radius(double radius, const Box& box) {
  if (radius > box.max_cutoff()) {
    throw CutoffTooLarge("cutoff + skin = " + describe(radius) + " exceeds " + describe(box.max_cutoff()) +
                         ", half the smallest height of the periodic box (" + describe(box.min_height()) +
                         "); lower the cutoff or the skin, or replicate the system");
  }
}

}  // namespace dch::detail
