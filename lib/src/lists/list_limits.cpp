// SPDX-License-Identifier: MIT
#include "lists/list_limits.hpp"

#include <algorithm>
#include <cmath>

namespace dch::detail {
namespace {

constexpr double kSquareScale = 0x1p15;  ///< squares are shifted right by 15 bits

std::int16_t clamped(double v) { return static_cast<std::int16_t>(std::clamp(v, 0.0, 32767.0)); }

// Errors, with all lengths in units: a difference of coordinates is off by at most 1 + s along each axis (two
// points, each rounded, and a shift that is off by s; rounding in float adds 0.05 to the distance at most),
// hence a distance d <= reach by off = sqrt(3) (1 + s), and its square by 2 off reach + off^2; halved 15
// times over, and three roundings of 1/2 added. The pair distance may differ by `error` more.
class Rounding {
 public:
  Rounding(double point_unit, double error, double shift_error)
      : unit_(point_unit), off_(std::sqrt(3.0) * (1 + shift_error) + 0.05 + 2 * error / point_unit) {}

  double limit(double reach) const { return reach / unit_ * (reach / unit_) / kSquareScale; }
  double band(double reach) const {
    return (2 * off_ * reach / unit_ + off_ * off_) / kSquareScale + 1.5 + 1e-6;
  }
  double off() const { return off_; }
  std::int16_t in(double reach) const { return clamped(std::floor(limit(reach) - band(reach)) + 1); }
  std::int16_t out(double reach) const { return clamped(std::floor(limit(reach) + band(reach)) + 1); }
  /// Without regard to rounding.
  std::int16_t nearest(double reach) const { return clamped(std::round(limit(std::max(reach, 0.0)))); }
  /// How far beyond `reach` a pair may be whose sum of squares does not exceed `sum` [length].
  double margin(double reach, double sum) const {
    return (std::sqrt((sum + 1.5 + 1e-6) * kSquareScale) + off_) * unit_ - reach;
  }

 private:
  double unit_, off_;
};

std::int16_t middle_of(std::int16_t in, std::int16_t out) {
  return static_cast<std::int16_t>(in + (out - in) / 2);
}
std::int16_t band_of(std::int16_t in, std::int16_t out) {
  return static_cast<std::int16_t>((out - in + 1) / 2);
}

void set_middles(int types, ListLimits::PairLimits& to) {
  to.type_middle.resize(static_cast<std::size_t>(types));
  for (int a = 0; a < types; ++a)
    for (int b = 0; b < types; ++b)
      to.band = std::max(to.band, band_of(to.type_in[a].limit[b], to.type_out[a].limit[b]));
  for (int a = 0; a < types; ++a) {
    for (int b = 0; b < types; ++b) {
      const std::int16_t in = to.type_in[a].limit[b], out = to.type_out[a].limit[b];
      to.type_middle[a].limit[b] = out > 0 ? middle_of(in, out) : static_cast<std::int16_t>(-to.band - 1);
    }
  }
}

/// The limits of each two types, of which there are at most kKernelTypes.
void set_by_types(const ListParams& params, const Rounding& rounding, double point_unit, double reach,
                  ListLimits& to) {
  const int types = params.cutoffs.types();
  to.type_cutoff.resize(static_cast<std::size_t>(types));
  to.all.type_in.resize(static_cast<std::size_t>(types));
  to.all.type_out.resize(static_cast<std::size_t>(types));
  to.near.type_in.resize(static_cast<std::size_t>(types));
  std::fill_n(to.farthest.limit, types, std::int16_t{1});  // keeps points at the very place, so a block's own
  for (int a = 0; a < types; ++a) {
    for (int b = 0; b < types; ++b) {
      if (params.cutoffs(a, b) == 0) continue;
      const double far = params.cutoffs(a, b) + params.skin;
      to.type_cutoff[a][b] = far / point_unit;
      to.all.type_in[a].limit[b] = rounding.in(far);
      to.all.type_out[a].limit[b] = rounding.out(far);
      to.near.type_in[a].limit[b] = rounding.nearest(far - params.shell);
      to.farthest.limit[b] = std::max(to.farthest.limit[b], rounding.out(std::min(far, reach)));
      to.margin = std::max(to.margin, rounding.margin(far, to.all.type_out[a].limit[b] - 1));
    }
  }
  to.near.type_out = to.near.type_in;
  set_middles(types, to.all);
}

}  // namespace

ListLimits::ListLimits(const PairFilter& filter, double point_unit, double reach, double error,
                       double shift_error)
    : by(filter.by()) {
  const Rounding rounding(point_unit, error, shift_error);
  const ListParams& params = filter.params();
  has_shell = params.shell > 0;
  const double largest = std::sqrt(filter.largest_distance2());
  const auto widen = [&](double pair_reach, double sum) {
    margin = std::max(margin, rounding.margin(pair_reach, sum));
  };
  switch (by) {
    case CutoffBy::one_cutoff:
      all.in = rounding.in(largest);
      all.out = rounding.out(largest);
      near.in = near.out = rounding.nearest(largest - params.shell);
      cutoff = largest / point_unit;
      off = rounding.off();
      widen(largest, all.out - 1);
      return;
    case CutoffBy::radii: {
      // The kernels round two radii and the skin, hence their sum by up to 3/2 (rounding in float adds 0.01
      // at most), and its square once more.
      constexpr double kOff = 1.51;
      off = rounding.off() + kOff;
      const double farthest_pair = std::min(largest, reach);
      const double sizes = (2 * kOff * farthest_pair / point_unit + kOff * kOff) / kSquareScale + 0.5;
      const double whole = std::floor(rounding.band(farthest_pair) + sizes) + 1;
      all.band = clamped(whole);
      all.skin = clamped(std::round(params.skin / point_unit));
      near.skin = clamped(std::round((params.skin - params.shell) / point_unit));
      const double least = 2 * filter.least_radius() + params.skin;  // the smaller, the more room
      widen(least, rounding.limit(least + kOff * point_unit) + 0.5 + all.band - 1);
      return;
    }
    case CutoffBy::types:
      break;
  }
  const int types = params.cutoffs.types();
  per_pair = types > kKernelTypes;
  if (per_pair) {
    all.out = rounding.out(std::min(largest, reach));
    near.in = near.out = rounding.nearest(largest - params.shell);
    return;  // decided pair by pair, whatever the margin
  }
  off = rounding.off();
  set_by_types(params, rounding, point_unit, reach, *this);
}

RowLimits ListLimits::for_rows(const PairLimits& pairs, bool take_open) const {
  RowLimits limits;
  if (by == CutoffBy::radii) {
    limits.skin = pairs.skin;
    (take_open ? limits.raise : limits.band) = pairs.band;
  } else if (by == CutoffBy::types && !per_pair) {
    limits.by_type = take_open ? pairs.type_out.data() : pairs.type_middle.data();
    limits.band = take_open ? std::int16_t{0} : pairs.band;
  } else {
    limits.middle = take_open ? pairs.out : middle_of(pairs.in, pairs.out);
    limits.band = take_open ? std::int16_t{0} : band_of(pairs.in, pairs.out);
  }
  return limits;
}

ReachLimit limit_of_reach(double reach, double point_unit, double shift_error) {
  const Rounding rounding(point_unit, 0, shift_error);
  const std::int16_t out = rounding.out(reach);
  return {out, rounding.margin(reach, out - 1)};
}

}  // namespace dch::detail
