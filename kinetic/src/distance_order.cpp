// SPDX-License-Identifier: MIT
#include "distance_order.hpp"

#include <algorithm>

#include "bracketed_root.hpp"

namespace dch::kinetic {
namespace {

int sign(double x) { return (x > 0) - (x < 0); }

/// Where a function changes its sign, ascending from 0 on, and its sign before the first one.
struct SignChanges {
  int first_sign = 0, count = 0;
  std::array<double, 4> at{};
};

/// Lowest coefficient first.
struct Polynomial {
  std::array<double, 5> c{};
  int degree = 0;

  double operator()(double x) const {
    double value = c[static_cast<std::size_t>(degree)];
    for (int k = degree - 1; k >= 0; --k) value = c[static_cast<std::size_t>(k)] + x * value;
    return value;
  }
  /// Far away.
  int last_sign() const {
    for (int k = degree; k >= 0; --k)
      if (c[static_cast<std::size_t>(k)] != 0) return sign(c[static_cast<std::size_t>(k)]);
    return 0;
  }
  Polynomial derivative() const {
    Polynomial slope;
    slope.degree = degree - 1;
    for (int k = 1; k <= degree; ++k)
      slope.c[static_cast<std::size_t>(k) - 1] = k * c[static_cast<std::size_t>(k)];
    return slope;
  }
};

/// Puts the signs of stretches together. Zero at the end of a stretch is no sign: the function only touches
/// it there, or the next stretch has another sign.
class SignWalk {
 public:
  void stretch(double from, int now) {
    if (now == 0) return;
    if (sign_ == 0) {
      found.first_sign = now;
    } else if (now != sign_) {
      found.at[static_cast<std::size_t>(found.count++)] = from;
    }
    sign_ = now;
  }
  SignChanges found;

 private:
  int sign_ = 0;
};

/// @param turns where the function turns, so that it is monotone between them and after the last one
/// @param last_sign far away
template <class Value, class Slope>
SignChanges sign_changes(const Value& value, const Slope& slope, const SignChanges& turns, int last_sign) {
  SignWalk walk;
  double low = 0;
  int sign_low = sign(value(low));
  for (int k = 0; k <= turns.count; ++k) {
    const bool is_last = k == turns.count;
    double high = is_last ? low : turns.at[static_cast<std::size_t>(k)];
    const int sign_high = is_last ? last_sign : sign(value(high));
    if (sign_low * sign_high < 0) {
      walk.stretch(low, sign_low);  // NOLINT(readability-suspicious-call-argument): low is where it begins
      if (is_last) {
        high = low > 0 ? 2 * low : 1;
        while (high < kMaxMagnitude && sign(value(high)) != sign_high) high *= 2;
        if (high >= kMaxMagnitude) break;  // beyond all times that are taken
      }
      walk.stretch(bracketed_root(value, slope, low, high), sign_high);
    } else {
      walk.stretch(low, sign_low != 0 ? sign_low : sign_high);
    }
    low = high;
    sign_low = sign_high;
  }
  return walk.found;
}

SignChanges sign_changes(const Polynomial& f) {
  if (f.degree == 0) {
    SignChanges constant;
    constant.first_sign = sign(f.c[0]);
    return constant;
  }
  const Polynomial slope = f.derivative();
  return sign_changes(f, slope, sign_changes(slope), f.last_sign());
}

/// A vector that is quadratic in time.
struct Path {
  Vec3 at, rate, half_gain;
  Vec3 operator()(double x) const { return at + x * (rate + x * half_gain); }
  Vec3 slope(double x) const { return rate + 2 * x * half_gain; }
};

Path from(const PairPath& pair, double start) {
  const double passed = start - pair.start;
  return {pair.apart + passed * (pair.velocity + (0.5 * passed) * pair.acceleration),
          pair.velocity + passed * pair.acceleration, 0.5 * pair.acceleration};
}

}  // namespace

PairPath::PairPath(const FlightPlan& first, const FlightPlan& second, Vec3 shift)
    : start(std::max(first.time, second.time)),
      apart((position_at(second, start) - position_at(first, start)) + shift),
      velocity(velocity_at(second, start) - velocity_at(first, start)),
      acceleration(second.acceleration - first.acceleration) {}

/// |d|^2 - |e|^2 = (d - e) . (d + e), which cancels nothing but what d and e have in common.
DistanceOrder::DistanceOrder(const PairPath& first, const PairPath& second) {
  const double start = std::max(first.start, second.start);
  const Path d = from(first, start), e = from(second, start);
  const Path less{d.at - e.at, d.rate - e.rate, d.half_gain - e.half_gain};
  const Path more{d.at + e.at, d.rate + e.rate, d.half_gain + e.half_gain};
  const bool is_linear = less.half_gain == Vec3{} && more.half_gain == Vec3{};
  const Polynomial f{
      {dot(less.at, more.at), dot(less.at, more.rate) + dot(less.rate, more.at),
       dot(less.at, more.half_gain) + dot(less.rate, more.rate) + dot(less.half_gain, more.at),
       dot(less.rate, more.half_gain) + dot(less.half_gain, more.rate), dot(less.half_gain, more.half_gain)},
      is_linear ? 2 : 4};
  const auto value = [&](double x) { return dot(less(x), more(x)); };
  const auto slope = [&](double x) { return dot(less.slope(x), more(x)) + dot(less(x), more.slope(x)); };
  const SignChanges found = sign_changes(value, slope, sign_changes(f.derivative()), f.last_sign());
  first_sign_ = found.first_sign;
  count_ = found.count;
  for (int k = 0; k < count_; ++k)
    changes_[static_cast<std::size_t>(k)] = start + found.at[static_cast<std::size_t>(k)];
}

int DistanceOrder::sign_after(double time) const {
  const double* const first = changes_.data();
  const auto passed = std::upper_bound(first, first + count_, time) - first;
  return passed % 2 == 0 ? first_sign_ : -first_sign_;
}

double DistanceOrder::next_change(double time) const {
  const double* const end = changes_.data() + count_;
  const double* const next = std::upper_bound(changes_.data(), end, time);
  if (next == end) return kNever;
  return *next;
}

}  // namespace dch::kinetic
