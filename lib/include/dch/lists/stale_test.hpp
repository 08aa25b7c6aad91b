// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// A particle that has moved farther than half the skin allows.
struct MovedParticle {
  std::int32_t particle;
  /// At least its displacement and its share of all rounding: the sum of two bounds how much closer to each
  /// other the two may have come [length].
  double moved;
};

/// Says when pairs within a cutoff might be missing from what was found with a skin beyond it: a list, or
/// cluster pairs.
///
/// What was found at positions x0 in box H0 holds every pair within the cutoff as long as
///     2 max_i |u_i| + max_n |(H - H0) n| <= skin,   n in {-1, 0, 1}^3,
/// where u_i is the shortest displacement of particle i in the present box H. The first term is the classical
/// skin/2 rule. The second bounds what a change of the box adds: H0 is the reduced basis of the periodic
/// vectors, H the same integer combinations of the present vectors, and since the heights of H0 are at least
/// 2 (cutoff + skin), the images of two wrapped particles that come within the cutoff differ by at most one
/// vector of each. Changes of the origin and of open axes move no pair. Another periodicity and another
/// number of particles are always stale.
///
/// Or as long as, for particles that go along with the box,
///     2 max_i |v_i| + (1 - s) r_list <= skin,
/// where v_i is the displacement from F x0_i, F = H H0^-1 the map that keeps fractional coordinates, and s
/// the factor by which it shortens displacements at most. While r_list is a fraction of the box, this allows
/// the box to change by much more: what moves with it costs nothing, and a pair is shorter than a period.
/// Changes of a vector by a quarter of a height or so are left to the first condition.
///
/// In a periodic box displacements and distances round: 1e-12 of the box or less for particles near it, and
/// about 1e-14 of the coordinates of boxes and particles far from the origin. A bound on that is taken from
/// the skin, so that what cannot be told is stale. Without a skin all but the very same positions and box
/// are.
class StaleTest {
 public:
  /// @throws InvalidParameter for a negative or non-finite skin [length].
  explicit StaleTest(double skin);

  /// True if a pair might be missing at these positions, if there is a NaN among them, and if none are
  /// remembered. O(n).
  bool is_stale(Span<const Vec3> positions, const Box& box) const;

  /// What the half-skin rule says of positions, and which particles break it.
  enum class Verdict {
    fresh,      ///< no pair can be missing
    some_fast,  ///< a pair can be missing only if a particle of it is one of the fast ones
    too_many,   ///< the same, but there are more of those than asked for
    stale       ///< a pair might be missing, whoever has moved: see is_stale()
  };
  /// is_stale() in detail: O(n), and `fast` gets the particles that have moved too far, ascending. A box that
  /// has changed in any way is left to is_stale(), and so are lists without a skin.
  /// @param most fast particles wanted; what `fast` holds if there are more has no meaning
  Verdict judge(Span<const Vec3> positions, const Box& box, std::size_t most,
                std::vector<MovedParticle>& fast) const;

  /// How far particles may be from the images of their places in which pairs were found, for judge() to find
  /// none of them fast, while the box is that of then; negative if it has to look at all [length].
  double allowance(std::size_t particles, const Box& box) const;
  /// judge(), if all but the candidates are known to be within allowance().
  /// @param candidates  ascending
  Verdict judge(Span<const Vec3> positions, const Box& box, Span<const std::int32_t> candidates,
                std::size_t most, std::vector<MovedParticle>& fast) const;

  /// Takes positions and the box that pairs are being found for. After a throw none are remembered.
  /// @param list_radius largest cutoff + skin of a pair [length]; half the smallest height if it is larger
  void remember(Span<const Vec3> positions, const Box& box,
                double list_radius = std::numeric_limits<double>::infinity());
  void forget() { valid_ = false; }

 private:
  bool is_comparable(std::size_t particles, const Box& box) const;
  bool is_kept_by_affine_motion(Span<const Vec3> positions, const Box& box) const;
  template <class Expected, class Fast>
  bool for_each_fast(Span<const Vec3> positions, const Box& box, const Expected& expected, double most,
                     const Fast& fast) const;
  double room(double most) const { return most - 2 * reference_error_; }
  void wrap_reference();
  std::array<Vec3, 3> periods(const Box& box) const;
  double strain(const Box& box) const;

  double skin_;
  std::vector<Vec3> reference_;  ///< positions, wrapped unless there is no skin
  Box reference_box_;
  double list_radius_ = 0;
  Vec3 low_, high_;             ///< corners of the box around them
  double reference_error_ = 0;  ///< how far distances of the wrapped positions may be off [length]
  /// Reduced periodic vectors of the reference box as integer combinations of its cell vectors.
  std::array<Vec3, 3> combinations_{};
  bool valid_ = false;
};

}  // namespace dch
#pragma GCC visibility pop
