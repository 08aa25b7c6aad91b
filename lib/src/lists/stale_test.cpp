// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>

#include <dch/lists/stale_test.hpp>

#include "geometry/affine_motion.hpp"
#include "geometry/lattice.hpp"
#include "geometry/position_check.hpp"
#include "lists/list_check.hpp"

namespace dch {

StaleTest::StaleTest(double skin) : skin_(skin) { detail::check_skin(skin); }

namespace {

constexpr std::size_t kAtATime = 16;  ///< particles that are looked at together: few hold a fast one

constexpr auto kStop = [](std::size_t, double) { return false; };

struct AtRest {
  Vec3 operator()(Vec3 p) const { return p; }
};

/// Whether one of particles [first, end) is displaced by more than that from where it was expected, or a NaN.
/// Without a branch for each.
template <class Expected>
bool any_beyond(Span<const Vec3> now, Span<const Vec3> then, std::size_t first, std::size_t end,
                const Expected& expected, double allowed2) {
  const auto is_beyond = [&](Vec3 a, Vec3 b) { return norm2(a - expected(b)) <= allowed2 ? 0 : 1; };
  const auto begin = static_cast<std::ptrdiff_t>(first), after = static_cast<std::ptrdiff_t>(end);
  return std::transform_reduce(std::next(now.begin(), begin), std::next(now.begin(), after),
                               std::next(then.begin(), begin), 0, std::plus<>(), is_beyond) != 0;
}

/// A particle that is farther from where it was expected than there is room for, rounding included; infinity
/// and NaN count as such.
struct FastOne {
  const Box& box;
  const detail::WrapError& error;
  double room;
  /// @return how far it has moved, with what rounding may have taken away; 0 if it is none
  double operator()(Vec3 now, Vec3 then) const {
    const double rounding = 2 * error.bound(error.reach(now) + error.reach(then));
    const double left = room - rounding, moved2 = norm2(box.nearest_image(now - then));
    if (left >= 0 && moved2 <= left * left) return 0;
    return std::sqrt(moved2) + rounding;
  }
};

/// Takes fast particles as long as there are not too many.
class FastList {
 public:
  FastList(std::size_t most, double more, std::vector<MovedParticle>& to)
      : most_(most), more_(more), to_(to) {
    to_.clear();
  }
  /// @return whether to go on
  bool take(std::size_t particle, double moved) {
    if (!std::isfinite(moved)) return false;
    are_too_many_ = to_.size() == most_;
    if (!are_too_many_) to_.push_back({static_cast<std::int32_t>(particle), moved + more_});
    return !are_too_many_;
  }
  /// @param looked_at_all  or take() has ended it
  StaleTest::Verdict verdict(bool looked_at_all) const {
    if (are_too_many_) return StaleTest::Verdict::too_many;
    if (!looked_at_all) return StaleTest::Verdict::stale;
    return to_.empty() ? StaleTest::Verdict::fresh : StaleTest::Verdict::some_fast;
  }

 private:
  std::size_t most_;
  double more_;
  std::vector<MovedParticle>& to_;
  bool are_too_many_ = false;
};

}  // namespace

bool StaleTest::is_comparable(std::size_t particles, const Box& box) const {
  return valid_ && particles == reference_.size() && same_periodicity(box, reference_box_);
}

bool StaleTest::is_stale(Span<const Vec3> positions, const Box& box) const {
  if (!is_comparable(positions.size(), box)) return true;
  if (skin_ == 0)
    return box != reference_box_ || !std::equal(positions.begin(), positions.end(), reference_.begin());
  if (box != reference_box_ && is_kept_by_affine_motion(positions, box)) return false;
  return !for_each_fast(positions, box, AtRest{}, 0.5 * (skin_ - strain(box)), kStop);
}

// With F for the map, v_i for the displacement of i from F x0_i, and r for that of a pair within its cutoff c
// now: r = F r0 + v_j - v_i, with r0 of the same image then, since F takes vectors of the box to those of
// now. F makes no displacement shorter than s times its length, s <= 1, so
//     |r0| <= (c + 2 max |v|) / s,
// which is c + skin or less if 2 max |v| <= skin - (1 - s) (c + skin).
bool StaleTest::is_kept_by_affine_motion(Span<const Vec3> positions, const Box& box) const {
  // Who follows a pair from time to time takes a particle for the image that has moved least.
  const double room = std::min(box.max_cutoff(), reference_box_.max_cutoff());
  if (!(2 * strain(box) + skin_ <= room)) return false;
  const detail::AffineMotion motion(reference_box_, periods(reference_box_), periods(box), box.origin());
  // The map takes of rounding a few times what wrapping does, in either box.
  constexpr double kRoundings = 8;
  const detail::WrapError before(reference_box_), now(box);
  const double rounding = kRoundings * (before.bound(before.reach_between(low_, high_)) +
                                        now.bound(now.reach_between(low_, high_)));
  const double lost = (1 - motion.least_stretch()) * std::min(list_radius_, reference_box_.max_cutoff());
  return for_each_fast(positions, box, motion, 0.5 * (skin_ - lost) - rounding, kStop);
}

StaleTest::Verdict StaleTest::judge(Span<const Vec3> positions, const Box& box, std::size_t most,
                                    std::vector<MovedParticle>& fast) const {
  fast.clear();
  if (!is_comparable(positions.size(), box) || skin_ == 0 || box != reference_box_)
    return is_stale(positions, box) ? Verdict::stale : Verdict::fresh;
  FastList list(most, 2 * reference_error_, fast);
  return list.verdict(for_each_fast(positions, box, AtRest{}, 0.5 * skin_,
                                    [&](std::size_t i, double moved) { return list.take(i, moved); }));
}

// A few times the bounds that are taken of the displacements between wrapped images: those of other images
// round by no more, and their places by what the remembered ones do.
double StaleTest::allowance(std::size_t particles, const Box& box) const {
  if (skin_ == 0 || !is_comparable(particles, box) || box != reference_box_) return -1;
  constexpr double kRoundings = 16;
  const detail::WrapError error(box);
  return room(0.5 * skin_) - 2 * reference_error_ -
         kRoundings * error.bound(error.reach_between(low_, high_));
}

StaleTest::Verdict StaleTest::judge(Span<const Vec3> positions, const Box& box,
                                    Span<const std::int32_t> candidates, std::size_t most,
                                    std::vector<MovedParticle>& fast) const {
  const detail::WrapError error(box);
  const FastOne moved_too_far{box, error, room(0.5 * skin_)};
  FastList list(most, 2 * reference_error_, fast);
  for (const std::int32_t candidate : candidates) {
    const auto i = static_cast<std::size_t>(candidate);
    const double moved = moved_too_far(positions[i], reference_[i]);
    if (moved != 0 && !list.take(i, moved)) return list.verdict(false);
  }
  return list.verdict(true);
}

/// Calls fast(i, moved) for the particles that are farther than `most` from where they were expected,
/// rounding included, until it returns false; infinity and NaN count as such. Returns whether all have been
/// looked at.
/// @param expected where a particle would be that was at a place at the time
template <class Expected, class Fast>
bool StaleTest::for_each_fast(Span<const Vec3> positions, const Box& box, const Expected& expected,
                              double most, const Fast& fast) const {
  // Of each particle there may be off by rounding: its remembered place, from which it is displaced and from
  // which pairs were found; the displacement; and its distance from others now.
  const detail::WrapError error(box);
  const FastOne moved_too_far{box, error, room(most)};
  // A particle that is near its wrapped place is hardly farther out than that.
  const double allowed = room(most) - 4 * error.bound(error.reach_between(low_, high_));
  if (!(allowed >= 0)) return false;
  const std::size_t n = positions.size();
  for (std::size_t first = 0, end = 0; first != n; first = end) {
    end = first + std::min(n - first, kAtATime);
    if (!any_beyond(positions, reference_, first, end, expected, allowed * allowed)) continue;
    for (std::size_t i = first; i != end; ++i) {
      const double moved = moved_too_far(positions[i], expected(reference_[i]));
      if (moved != 0 && !fast(i, moved)) return false;
    }
  }
  return true;
}

void StaleTest::remember(Span<const Vec3> positions, const Box& box, double list_radius) {
  valid_ = false;  // until all of it has changed
  list_radius_ = list_radius;
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
