// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/kinetic/contacts_between.hpp>
#include <dch/lists/list_params.hpp>

#include "lists/pair_filter.hpp"

namespace dch::kinetic {

/// Tells the contact of one image of a pair between two frames, in closed form.
class PassFinder {
 public:
  /// @param error by which places at the middle of the interval may be off [length]
  PassFinder(double cutoff, double error, Span<const Vec3> before, const Box& box_before,
             Span<const Vec3> after, const Box& box_after);
  PassFinder(const PassFinder&) = delete;
  PassFinder& operator=(const PassFinder&) = delete;

  /// The contact, if there is one; it may last from frame to frame.
  /// @param apart from i to the image of j at t = 1/2
  /// @param rate of that, all the time
  std::optional<PassingContact> find(std::int32_t i, std::int32_t j, Vec3 apart, Vec3 rate) const {
    const double before2 = norm2(apart - 0.5 * rate), after2 = norm2(apart + 0.5 * rate);
    if (before2 > out_above_ && after2 > out_above_) {
      // The way's nearest point has to lie on it: most pairs end here
      const double advance = dot(apart, rate);
      if (2 * std::abs(advance) >= norm2(rate)) return std::nullopt;
    }
    return closed_form(i, j, apart, rate, before2, after2);
  }

 private:
  std::optional<PassingContact> closed_form(std::int32_t i, std::int32_t j, Vec3 d, Vec3 v, double before2,
                                            double after2) const;
  /// Whether a frame shows the pair: where rounding may decide, as lists do.
  bool is_shown(double distance2, const detail::PairFilter& frame, std::int32_t i, std::int32_t j) const {
    if (distance2 > out_above_) return false;
    return distance2 < in_below_ || frame.accept(i, j);
  }

  ListParams params_;
  double cutoff2_, in_below_, out_above_;
  detail::PairFilter before_, after_;
};

}  // namespace dch::kinetic
