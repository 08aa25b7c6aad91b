// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <dch/necklace/bond_encounter.hpp>

/// Crossings of bonds in exact arithmetic, by halving in Bernstein form: shares neither code nor method with
/// the library, which goes by Sturm's sequences. Motions that are not generic are for
/// crossing_perturbation.hpp.
namespace dch::crossing_oracle {

using Int = boost::multiprecision::cpp_int;
/// Bernstein coefficients over an interval, up to a positive factor.
using Bernstein = std::vector<Int>;

/// Coordinates are multiples of 2^-kUnitBits.
inline constexpr int kUnitBits = 60;

inline Int whole(double x) {
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int shift = exponent - 53 + kUnitBits;
  if (shift >= 0) return Int(mantissa) << shift;
  return Int(mantissa) / (Int(1) << -shift);  // exact for such multiples
}

struct Event {
  double time = 0;
  int sign = 0;  ///< of what the determinant becomes
};

/// Ends of two bonds as integers: P's a and b, Q's a and b.
struct WholeMotion {
  using Point = std::array<Int, 3>;
  std::array<Point, 4> from, to;

  WholeMotion(const necklace::MovingBond& p, const necklace::MovingBond& q) {
    const std::array<std::array<Vec3, 2>, 4> ends{
        {{p.from_a, p.to_a}, {p.from_b, p.to_b}, {q.from_a, q.to_a}, {q.from_b, q.to_b}}};
    for (std::size_t k = 0; k < 4; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        from[k][static_cast<std::size_t>(axis)] = whole(ends[k][0][axis]);
        to[k][static_cast<std::size_t>(axis)] = whole(ends[k][1][axis]);
      }
    }
  }
};

/// The roots of a motion at which the bonds meet inside, or nothing if the motion is not generic.
class Oracle {
 public:
  Oracle(const necklace::MovingBond& p, const necklace::MovingBond& q) : Oracle(WholeMotion(p, q)) {}
  explicit Oracle(const WholeMotion& motion, int depth = 200) : depth_(depth) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto difference = [&](std::size_t a, std::size_t b) {
        return Linear{motion.from[b][axis] - motion.from[a][axis], motion.to[b][axis] - motion.to[a][axis]};
      };
      p_[axis] = difference(0, 1);
      q_[axis] = difference(2, 3);
      between_[axis] = difference(0, 2);
    }
    f_.assign(4, 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Bernstein part = scaled_product(product(p_, q_, axis), between_[axis]);
      for (std::size_t k = 0; k < 4; ++k) f_[k] += part[k];
    }
    f_[1] /= 3, f_[2] /= 3;  // exact, since all are times 3
  }

  /// @return nothing where a sign is zero, or not seen to differ from zero after as many halvings as allowed
  std::optional<std::vector<Event>> events() {
    if (f_.front() == 0 || f_.back() == 0) return std::nullopt;
    std::vector<Event> found;
    generic_ = true;
    search(f_, quadratics(), 0, 1, 0, found);
    if (!generic_) return std::nullopt;
    return found;
  }

 private:
  using Linear = std::array<Int, 2>;
  using LinearVector = std::array<Linear, 3>;

  /// Component of a cross product, as coefficients of degree 2 times (1, 2, 1).
  static std::array<Int, 3> product(const LinearVector& a, const LinearVector& b, std::size_t axis) {
    const Linear &ay = a[(axis + 1) % 3], &az = a[(axis + 2) % 3], &by = b[(axis + 1) % 3],
                 &bz = b[(axis + 2) % 3];
    return {ay[0] * bz[0] - az[0] * by[0], ay[0] * bz[1] + ay[1] * bz[0] - az[0] * by[1] - az[1] * by[0],
            ay[1] * bz[1] - az[1] * by[1]};
  }
  /// Of degree 3, times (1, 3, 3, 1) and 3.
  static Bernstein scaled_product(const std::array<Int, 3>& a, const Linear& b) {
    return {3 * a[0] * b[0], 3 * (a[1] * b[0] + a[0] * b[1]), 3 * (a[2] * b[0] + a[1] * b[1]),
            3 * a[2] * b[1]};
  }

  /// By axis: the normal's component, then the numerators of both parameters and of what they lack of 1, all
  /// times 2.
  std::vector<Bernstein> quadratics() const {
    std::vector<Bernstein> result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto normal = product(p_, q_, axis), of_p = product(between_, q_, axis),
                 of_q = product(between_, p_, axis);
      const auto bernstein = [](const std::array<Int, 3>& c) { return Bernstein{2 * c[0], c[1], 2 * c[2]}; };
      const auto less = [&](const std::array<Int, 3>& c) {
        return bernstein({normal[0] - c[0], normal[1] - c[1], normal[2] - c[2]});
      };
      result.insert(result.end(),
                    {bernstein(normal), bernstein(of_p), less(of_p), bernstein(of_q), less(of_q)});
    }
    return result;
  }

  /// 0 unless all have one sign.
  static int sign(const Bernstein& c) {
    int result = 0;
    for (const Int& value : c) {
      const int here = value.sign();
      if (here == 0 || (result != 0 && here != result)) return 0;
      result = here;
    }
    return result;
  }
  static int variations(const Bernstein& c) {
    int count = 0, last = 0;
    for (const Int& value : c) {
      if (value.sign() != 0 && last != 0 && value.sign() != last) ++count;
      if (value.sign() != 0) last = value.sign();
    }
    return count;
  }

  /// Both parts of a split at share / base, times base^degree.
  static std::pair<Bernstein, Bernstein> split(Bernstein c, int share, int base) {
    const std::size_t degree = c.size() - 1;
    std::vector<Int> scale(c.size(), 1);
    for (std::size_t k = 1; k <= degree; ++k) scale[k] = scale[k - 1] * base;
    Bernstein left, right(c.size());
    for (std::size_t k = 0; k <= degree; ++k) {
      left.push_back(c[0] * scale[degree - k]);
      right[degree - k] = c[degree - k] * scale[degree - k];
      for (std::size_t n = 0; n + 1 < c.size() - k; ++n) c[n] = (base - share) * c[n] + share * c[n + 1];
    }
    return {left, right};
  }

  void search(const Bernstein& f, const std::vector<Bernstein>& tests, double low, double high, int depth,
              std::vector<Event>& found) {
    if (!generic_ || sign(f) != 0) return;
    if (variations(f) == 0) return;  // roots at the ends are none within
    if (f.front() == 0 || f.back() == 0) return void(generic_ = false);
    const std::array<int, 15> signs = signs_of(tests);
    if (variations(f) == 1) {
      int verdict = meets(signs);
      if (verdict == 0) verdict = meets(signs_at_root(f, tests));
      if (verdict == 0) return void(generic_ = false);
      if (verdict > 0) found.push_back({low + (high - low) * root_of(f), f.back().sign()});
      return;
    }
    // Roots at one time, of which none is an event or all are, and whose signs cancel.
    if (depth > 54 && f.front().sign() == f.back().sign() && meets(signs) != 0) return;
    if (depth == depth_) return void(generic_ = false);
    // In the middle, or where no root is.
    int share = 1, base = 2;
    for (const int eighths : {3, 5, 2}) {
      if (split(f, share, base).first.back() != 0) break;
      share = eighths, base = 8;
    }
    const auto [left, right] = split(f, share, base);
    std::vector<Bernstein> left_tests, right_tests;
    for (const Bernstein& test : tests) {
      auto [a, b] = split(test, share, base);
      left_tests.push_back(std::move(a));
      right_tests.push_back(std::move(b));
    }
    const double middle = low + (high - low) * share / base;
    search(left, left_tests, low, middle, depth + 1, found);
    search(right, right_tests, middle, high, depth + 1, found);
  }

  static std::array<int, 15> signs_of(const std::vector<Bernstein>& tests) {
    std::array<int, 15> signs{};
    for (std::size_t k = 0; k < signs.size(); ++k) signs[k] = sign(tests[k]);
    return signs;
  }

  /// Halves an interval about the only root of a cubic in it.
  class RootSearch {
   public:
    explicit RootSearch(const Bernstein& f)
        : a_{f[0], 3 * (f[1] - f[0]), 3 * (f[2] - 2 * f[1] + f[0]), f[3] - 3 * f[2] + 3 * f[1] - f[0]} {}
    void halve() {
      low_ *= 2;
      ++bits_;
      const Int middle = low_ + 1;
      const Int value = ((a_[3] * middle + (a_[2] << bits_)) * middle + (a_[1] << 2 * bits_)) * middle +
                        (a_[0] << 3 * bits_);
      if (value.sign() == a_[0].sign()) low_ = middle;
    }
    /// The root is in [low, low + 1] times 2^-bits.
    const Int& low() const { return low_; }
    unsigned bits() const { return bits_; }

   private:
    std::array<Int, 4> a_;
    Int low_ = 0;
    unsigned bits_ = 0;
  };

  /// The only root of f, as a share of its interval.
  static double root_of(const Bernstein& f) {
    RootSearch search(f);
    while (search.bits() < 62) search.halve();
    return std::ldexp(static_cast<double>(static_cast<std::int64_t>(search.low())), -62);
  }

  /// Signs of the tests about the only root of f, from halving f alone; 0 where they are not known.
  std::array<int, 15> signs_at_root(const Bernstein& f, const std::vector<Bernstein>& tests) const {
    RootSearch search(f);
    std::array<int, 15> signs{};
    while (search.bits() < 2 * static_cast<unsigned>(depth_) && meets(signs) == 0) {
      search.halve();
      const unsigned bits = search.bits();
      if (bits % 128 != 0 && (bits > 64 || (bits & (bits - 1)) != 0)) continue;
      for (std::size_t k = 0; k < signs.size(); ++k) signs[k] = sign_within(tests[k], search.low(), bits);
    }
    return signs;
  }

  /// The sign of a quadratic from low to low + 1, times 2^-shift; 0 if it is not known.
  static int sign_within(const Bernstein& test, const Int& low, unsigned shift) {
    const Int first = 2 * (test[1] - test[0]), second = test[2] - 2 * test[1] + test[0];
    const Int value = (second * low + (first << shift)) * low + (test[0] << 2 * shift);
    const Int change = ((abs(first) + 2 * abs(second)) << shift) + abs(second);
    return abs(value) > change ? value.sign() : 0;
  }

  /// 1: the lines meet inside both bonds wherever the tests have these signs; -1: nowhere; 0: not known.
  static int meets(const std::array<int, 15>& signs) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int orientation = signs[5 * axis];
      if (orientation == 0) continue;
      int inside = 0;
      for (std::size_t k = 1; k < 5; ++k) {
        const int side = orientation * signs[5 * axis + k];
        if (side < 0) return -1;
        inside += side;
      }
      if (inside == 4) return 1;
    }
    return 0;
  }

  int depth_;
  LinearVector p_, q_, between_;
  Bernstein f_;
  bool generic_ = true;
};

}  // namespace dch::crossing_oracle
