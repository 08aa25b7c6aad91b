// SPDX-License-Identifier: MIT
#include "geometry/position_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include <dch/base/error.hpp>
#include <dch/base/index_count.hpp>

#include "base/describe.hpp"
#include "geometry/dual_basis.hpp"

namespace dch::detail {
namespace {

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

/// Coordinates of two points: as many as the narrowest vector registers hold, thrice.
class TwoPoints {
 public:
  static constexpr int kRegisters = 3;
  using Pair __attribute__((vector_size(2 * sizeof(double)))) = double;
  explicit TwoPoints(const Vec3* at) { std::memcpy(part_, at, sizeof part_); }
  TwoPoints(Vec3 a, Vec3 b) {
    const Vec3 both[2] = {a, b};
    std::memcpy(part_, both, sizeof part_);
  }
  Pair& operator[](int k) { return part_[k]; }
  Pair operator[](int k) const { return part_[k]; }
  Vec3 point(int which) const {
    Vec3 both[2];
    std::memcpy(both, part_, sizeof part_);
    return both[which];
  }

 private:
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  Pair part_[kRegisters];
};

/// The box around positions, and whether all of them are finite.
struct Surroundings {
  explicit Surroundings(Span<const Vec3> positions) {
    TwoPoints least(positions[0], positions[0]), most = least;
    TwoPoints differences({}, {});  // of a number with itself: 0, but not for infinity and NaN
    const auto add = [&](const TwoPoints& two) {
      for (int k = 0; k < TwoPoints::kRegisters; ++k) {
        const TwoPoints::Pair x = two[k];
        least[k] = x < least[k] ? x : least[k];
        most[k] = x > most[k] ? x : most[k];
        differences[k] += x - x;  // NOLINT(misc-redundant-expression): see above
      }
    };
    const std::size_t n = positions.size();
    for (std::size_t i = 0; i + 1 < n; i += 2) add(TwoPoints(&positions[i]));
    add({positions[0], positions[n - 1]});  // the last one may have been alone
    const Vec3 a = least.point(0), b = least.point(1), c = most.point(0), d = most.point(1);
    low = {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
    high = {std::max(c.x, d.x), std::max(c.y, d.y), std::max(c.z, d.z)};
    const Vec3 sum = differences.point(0) + differences.point(1);
    are_finite = sum.x + sum.y + sum.z == 0;
  }
  double largest_coordinate() const { return std::max({-low.x, -low.y, -low.z, high.x, high.y, high.z}); }
  Vec3 low, high;
  bool are_finite;
};

}  // namespace

PositionCheck::PositionCheck(const Box& box)
    : error_(box),
      tolerance_(box.any_periodic() ? 0.5 * box.min_height() : 1),
      farthest_(error_.reach_within(tolerance_)) {}

std::optional<double> PositionCheck::reach_by_box(Span<const Vec3> positions) const {
  if (positions.empty()) return 0;
  const Surroundings around(positions);
  const double largest = error_.reach_between(around.low, around.high);
  if (around.are_finite && around.largest_coordinate() <= kMaxCoordinate && largest <= farthest_)
    return largest;
  return std::nullopt;
}

double PositionCheck::reach_of_each(Span<const Vec3> positions) const {
  double largest = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 p = positions[i];
    if (!(in_range(p.x) && in_range(p.y) && in_range(p.z))) {
      throw InvalidPosition(position_text(i, p) + " is not finite or beyond " + describe(kMaxCoordinate) +
                            "; check the coordinates of this frame");
    }
    const double reach = error_.reach(p);
    if (reach > farthest_) {
      throw InvalidPosition(
          position_text(i, p) +
          " is so far outside the periodic box that rounding leaves its place there uncertain by " +
          describe(error_.bound(reach)) + "; at most " + describe(tolerance_) + " is allowed, " +
          (error_.bound(0) > tolerance_ ? "shift the box and the coordinates to the origin"
                                        : "wrap the coordinates first"));
    }
    largest = std::max(largest, reach);
  }
  return largest;
}

double check_positions(Span<const Vec3> positions, const Box& box) {
  index_count(static_cast<std::int64_t>(positions.size()), "particles", "divide the system");
  const PositionCheck check(box);
  const std::optional<double> reach = check.reach_by_box(positions);
  return reach ? *reach : check.reach_of_each(positions);
}

void check_radius(double radius, const Box& box) {
  if (radius > box.max_cutoff()) {
    throw CutoffTooLarge("cutoff + skin = " + describe(radius) + " exceeds " + describe(box.max_cutoff()) +
                         ", half the smallest height of the periodic box (" + describe(box.min_height()) +
                         "); lower the cutoff or the skin, or replicate the system");
  }
}

}  // namespace dch::detail
