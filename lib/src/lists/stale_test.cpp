// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <dch/lists/stale_test.hpp>

#include "geometry/lattice.hpp"
#include "geometry/position_check.hpp"
#include "lists/list_check.hpp"

namespace dch {

StaleTest::StaleTest(double skin) : skin_(skin) { detail::check_skin(skin); }

bool StaleTest::is_stale(Span<const Vec3> positions, const Box& box) const {
  if (!valid_ || positions.size() != reference_.size() || !same_periodicity(box, reference_box_)) return true;
  if (skin_ == 0)
    return box != reference_box_ || !std::equal(positions.begin(), positions.end(), reference_.begin());

  // Of each particle there may be off by rounding: its remembered place, from which it is displaced and from
  // which pairs were found; the displacement; and its distance from others now.
  const detail::WrapError error(box);
  const double room = 0.5 * (skin_ - strain(box)) - 2 * reference_error_;
  // A particle that is near its wrapped place is hardly farther out than that.
  const double allowed = room - 4 * error.bound(error.reach_between(low_, high_));
  if (!(allowed >= 0)) return true;
  return !std::equal(positions.begin(), positions.end(), reference_.begin(), [&](Vec3 now, Vec3 then) {
    const Vec3 d = now - then;
    if (norm2(d) <= allowed * allowed) return true;
    const double left = room - 2 * error.bound(error.reach(now) + error.reach(then));
    return left >= 0 && norm2(box.nearest_image(d)) <= left * left;
  });
}

// The bounds are those of is_stale(), particle by particle: one that keeps within `left` there has, with its
// share of all rounding, moved by half the skin at most.
StaleTest::Verdict StaleTest::judge(Span<const Vec3> positions, const Box& box, std::size_t most,
                                    std::vector<MovedParticle>& fast) const {
  fast.clear();
  if (!valid_ || positions.size() != reference_.size() || skin_ == 0 || box != reference_box_)
    return is_stale(positions, box) ? Verdict::stale : Verdict::fresh;
  const detail::WrapError error(box);
  const double room = 0.5 * skin_ - 2 * reference_error_;
  const double allowed = room - 4 * error.bound(error.reach_between(low_, high_));
  if (!(allowed >= 0)) return Verdict::stale;
  const double allowed2 = allowed * allowed;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 d = positions[i] - reference_[i];
    if (norm2(d) <= allowed2) continue;
    const double rounding = 2 * error.bound(error.reach(positions[i]) + error.reach(reference_[i]));
    const double moved = std::sqrt(norm2(box.nearest_image(d)));
    if (moved <= room - rounding) continue;
    if (!std::isfinite(moved + rounding)) return Verdict::stale;
    if (fast.size() == most) return Verdict::too_many;
    fast.push_back({static_cast<std::int32_t>(i), moved + rounding + 2 * reference_error_});
  }
  return fast.empty() ? Verdict::fresh : Verdict::some_fast;
}

void StaleTest::remember(Span<const Vec3> positions, const Box& box) {
  valid_ = false;  // until all of it has changed
  reference_.assign(positions.begin(), positions.end());
  reference_box_ = box;
  if (skin_ > 0) wrap_reference();
  valid_ = true;
}

/// Wraps what is remembered, and finds the lattice's short vectors.
void StaleTest::wrap_reference() {
  const Box& box = reference_box_;
  const detail::WrapError error(box);
  double reach = 0;
  low_ = high_ = reference_.empty() ? box.origin() : box.wrap(reference_[0]);
  for (Vec3& p : reference_) {
    reach = std::max(reach, error.reach(p));
    p = box.wrap(p);
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
  }
  reference_error_ = error.bound(reach);

  const detail::Lattice lattice(box);
  for (std::size_t k = 0; k < 3; ++k) combinations_[k] = lattice.integers(box.reduced()[k]);
}

std::array<Vec3, 3> StaleTest::periods(const Box& box) const {
  const detail::Lattice lattice(box);
  return {lattice.vector(combinations_[0]), lattice.vector(combinations_[1]),
          lattice.vector(combinations_[2])};
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
