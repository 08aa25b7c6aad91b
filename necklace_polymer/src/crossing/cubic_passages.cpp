// SPDX-License-Identifier: MIT
#include "crossing/cubic_passages.hpp"

#include <cstddef>

#include "crossing/segment_distance.hpp"

namespace dch::necklace::detail {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// After so many halvings an interval is left undecided.
constexpr int kMaxDepth = 24;
/// 32 sqrt(epsilon)
constexpr double kParallel = 0x1p-21;

struct Interval {
  std::array<double, 4> c;  ///< Bernstein coefficients over it
  double low, high;
  int depth;
};

enum class Sides { positive, negative, mixed };

class Cubic {
 public:
  explicit Cubic(const PairMotion& motion) : motion_(motion) {
    const Vec3 first = cross(motion.bond_p[0], motion.bond_q[0]);
    const Vec3 mixed = cross(motion.bond_p[0], motion.bond_q[1]) + cross(motion.bond_p[1], motion.bond_q[0]);
    const Vec3 last = cross(motion.bond_p[1], motion.bond_q[1]);
    const Vec3 d0 = motion.between[0], d1 = motion.between[1];
    c_ = {dot(first, d0), (dot(mixed, d0) + dot(first, d1)) / 3, (dot(last, d0) + dot(mixed, d1)) / 3,
          dot(last, d1)};
    // A coefficient is an average of determinants, six products of three factors each. Factors off by `error`
    // make 18 error size^2; the roundings, of at most 20 operations on numbers of up to 6 size^3, make 60
    // epsilon size^3, and three more in each of the halvings, of evaluating at most once and of finding
    // signs, make 3 * 6 (24 + 60) / 2 epsilon size^3. What underflows comes to less than the smallest normal
    // number.
    const double s = motion.size, e = motion.error;
    error_ = 32 * e * (s + e) * (s + e) + 1024 * kEpsilon * s * s * s + std::numeric_limits<double>::min();
  }

  CubicPassages passages() {
    const Interval whole{c_, 0, 1, 0};
    result_.without_root = sides(whole) != Sides::mixed;
    search(whole);
    return result_;
  }

 private:
  Sides sides(const Interval& interval) const {
    const auto [low, high] = std::minmax_element(interval.c.begin(), interval.c.end());
    return *low > error_ ? Sides::positive : *high < -error_ ? Sides::negative : Sides::mixed;
  }
  int sign(double value) const { return value > error_ ? 1 : value < -error_ ? -1 : 0; }

  /// Whether there is exactly one root, and a simple one: the ends differ in sign, and either the other
  /// coefficients change sign once with them, or all differences of neighbors have one sign.
  bool has_one_root(const Interval& interval) const {
    const auto& c = interval.c;
    if (sign(c[0]) * sign(c[3]) != -1) return false;
    if (sign(c[1]) != 0 && sign(c[2]) != 0) return !(sign(c[1]) == sign(c[3]) && sign(c[2]) == sign(c[0]));
    const double up = c[3] > 0 ? 1 : -1;
    return up * (c[1] - c[0]) > 2 * error_ && up * (c[2] - c[1]) > 2 * error_ &&
           up * (c[3] - c[2]) > 2 * error_;
  }

  void search(const Interval& interval) {
    if (!result_.certain || sides(interval) != Sides::mixed || is_apart(interval.low, interval.high)) return;
    if (has_one_root(interval)) return take_root(interval);
    if (interval.depth == kMaxDepth) {
      result_.certain = false;
      return;
    }
    const auto& c = interval.c;
    const double m01 = 0.5 * (c[0] + c[1]), m12 = 0.5 * (c[1] + c[2]), m23 = 0.5 * (c[2] + c[3]);
    const double left = 0.5 * (m01 + m12), right = 0.5 * (m12 + m23), middle = 0.5 * (left + right);
    const double t = 0.5 * (interval.low + interval.high);
    search({{c[0], m01, left, middle}, interval.low, t, interval.depth + 1});
    search({{middle, right, m23, c[3]}, t, interval.high, interval.depth + 1});
  }

  /// Whether the bonds stay away from each other from `low` to `high`: they are too far apart halfway. For
  /// bonds at an angle of a, rounding moves the feet of their perpendicular by epsilon / a^2 of their size,
  /// or loses them, and the distance by no more than a size: sqrt(epsilon) size at worst.
  bool is_apart(double low, double high) const {
    const double t = 0.5 * (low + high);
    const double reach =
        0.5 * (high - low) * motion_.largest_speed() + 8 * motion_.error + kParallel * motion_.size;
    return closest_on_segments(PairMotion::at(motion_.bond_p, t), PairMotion::at(motion_.bond_q, t),
                               PairMotion::at(motion_.between, t))
               .distance2 > reach * reach * (1 + 1e-10);
  }

  double value(double t) const {
    const double s = 1 - t;
    const double a = s * c_[0] + t * c_[1], b = s * c_[1] + t * c_[2], c = s * c_[2] + t * c_[3];
    return s * (s * a + t * b) + t * (s * b + t * c);
  }

  void take_root(const Interval& interval) {
    double low = interval.low, high = interval.high;
    const int after = sign(interval.c[3]);
    // Within 2^-50, or as near as signs are certain.
    while (high - low > 0x1p-50) {
      const double t = 0.5 * (low + high);
      const int here = sign(value(t));
      if (here == 0) {
        close_in(t, after, low, high);
        break;
      }
      (here == after ? high : low) = t;
    }
    decide(low, high, after);
  }

  /// The sign at t is uncertain: looks on both sides of it for the nearest places where it is not.
  void close_in(double t, int after, double& low, double& high) const {
    const auto look = [&](double direction, int expected, double& end) {
      for (int power = -50; std::ldexp(1.0, power) < std::abs(end - t); ++power) {
        const double place = t + direction * std::ldexp(1.0, power);
        if (sign(value(place)) != expected) continue;
        end = place;
        return;
      }
    };
    look(-1, -after, low);
    look(1, after, high);
  }

  /// Whether the bonds meet at the root in [low, high].
  void decide(double low, double high, int after) {
    const double t = 0.5 * (low + high);
    const Vec3 p = PairMotion::at(motion_.bond_p, t), q = PairMotion::at(motion_.bond_q, t);
    const Vec3 between = PairMotion::at(motion_.between, t);
    const Vec3 normal = cross(p, q), of_p = cross(between, q), of_q = cross(between, p);
    // Components of the products change by at most 16 size^2 over a unit of time.
    const double s = motion_.size + motion_.error;
    const double error = 16 * s * ((high - low) * s + motion_.error) + 64 * kEpsilon * s * s +
                         std::numeric_limits<double>::min();
    int axis = 0;
    for (const int k : {1, 2}) {
      if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    }
    const double whole = std::abs(normal[axis]), orientation = normal[axis] < 0 ? -1 : 1;
    bool inside = whole > error, outside = false;
    for (const double part : {orientation * of_p[axis], orientation * of_q[axis]}) {
      outside |= part < -error || part - whole > 2 * error;
      inside &= part > error && whole - part > 2 * error;
    }
    if (whole > error && outside) return;
    if (!inside) {
      result_.certain = false;
      return;
    }
    if (result_.count == 3) {  // cannot be, of a cubic
      result_.certain = false;
      return;
    }
    result_.passages[static_cast<std::size_t>(result_.count++)] = {t, orientation * of_p[axis] / whole,
                                                                   orientation * of_q[axis] / whole, after};
  }

  const PairMotion& motion_;
  std::array<double, 4> c_{};
  double error_ = 0;
  CubicPassages result_;
};

}  // namespace

CubicPassages cubic_passages(const PairMotion& motion) { return Cubic(motion).passages(); }

}  // namespace dch::necklace::detail
