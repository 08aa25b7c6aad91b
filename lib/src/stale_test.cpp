// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <dch/stale_test.hpp>

#include "dual_basis.hpp"
#include "position_check.hpp"

namespace dch {

StaleTest::StaleTest(double skin) : skin_(skin) { detail::check_skin(skin); }

bool StaleTest::is_stale(Span<const Vec3> positions, const Box& box) const {
  if (!valid_ || positions.size() != reference_.size() || !same_periodicity(box, reference_box_)) return true;
  const double allowed = 0.5 * (skin_ - strain(box));
  if (!(allowed >= 0)) return true;
  return !std::equal(positions.begin(), positions.end(), reference_.begin(), [&](Vec3 now, Vec3 then) {
    return norm2(box.nearest_image(now - then)) <= allowed * allowed;
  });
}

void StaleTest::remember(Span<const Vec3> positions, const Box& box) {
  valid_ = false;  // until all of it has changed
  reference_.assign(positions.begin(), positions.end());
  for (Vec3& p : reference_) p = box.wrap(p);
  reference_box_ = box;

  std::array<Vec3, 3> given{};
  std::array<std::size_t, 3> axes{};
  std::size_t rank = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!box.periodic(axis)) continue;
    given[rank] = box.vector(axis);
    axes[rank++] = static_cast<std::size_t>(axis);
  }
  const auto dual = detail::dual_basis(given, box.rank());
  combinations_ = {};
  for (std::size_t k = 0; k < rank; ++k) {
    for (std::size_t l = 0; l < rank; ++l) {
      combinations_[k][axes[l]] = std::nearbyint(dot(dual[l], box.reduced()[k]));
    }
  }
  valid_ = true;
}

std::array<Vec3, 3> StaleTest::periods(const Box& box) const {
  std::array<Vec3, 3> periods;
  for (std::size_t k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      periods[k] = periods[k] + combinations_[k][static_cast<std::size_t>(axis)] * box.vector(axis);
    }
  }
  return periods;
}

/// The largest |(H - H0) n|, n in {-1, 0, 1}^3.
double StaleTest::strain(const Box& box) const {
  const auto before = periods(reference_box_), now = periods(box);
  const Vec3 a = now[0] - before[0], b = now[1] - before[1], c = now[2] - before[2];
  double largest = 0;  // at a corner of the cube of n, and the same at the opposite one
  for (const Vec3 v : {a + b + c, a + b - c, a - b + c, a - b - c}) largest = std::max(largest, norm2(v));
  return std::sqrt(largest);
}

}  // namespace dch
