// SPDX-License-Identifier: MIT
#include "crossing/exact_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "crossing/polynomial.hpp"

namespace dch::necklace::detail {
namespace {

constexpr std::size_t kTimeBits = 64;
constexpr double kSameTime = 0x1p-50;
/// Coordinates that differ by hundreds of orders of magnitude would ask for more, and for minutes.
constexpr std::size_t kMaxEpsilonBits = 8192;

/// Coordinates of a bead at one time, as integers times one power of two for all.
using ExactCoordinates = std::array<Integer, 3>;

/// All eight points on a common grid.
class Grid {
 public:
  explicit Grid(const PairEnds& ends) {
    for (const bool at_end : {false, true}) {
      for (const ExactPoint& point : at_end ? ends.to : ends.from) {
        const auto& cell = at_end ? ends.cell_to : ends.cell_from;
        for (int axis = 0; axis < 3; ++axis) {
          note(point.given[axis]);
          for (std::size_t k = 0; k < 3; ++k) {
            if (point.image[k] != 0) note(cell[k][axis]);
          }
        }
      }
    }
  }

  ExactCoordinates place(const ExactPoint& point, const std::array<Vec3, 3>& cell) const {
    ExactCoordinates result;
    for (int axis = 0; axis < 3; ++axis) {
      Integer value = whole(point.given[axis]);
      for (std::size_t k = 0; k < 3; ++k) {
        if (point.image[k] != 0) value += Integer(point.image[k]) * whole(cell[k][axis]);
      }
      result[static_cast<std::size_t>(axis)] = std::move(value);
    }
    return result;
  }

 private:
  /// x = mantissa * 2^exponent with an odd mantissa
  static std::int64_t split(double x, int& exponent) {
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    exponent -= 53;
    while (mantissa != 0 && mantissa % 2 == 0) mantissa /= 2, ++exponent;
    return mantissa;
  }
  void note(double x) {
    int exponent = 0;
    if (split(x, exponent) != 0) lowest_ = std::min(lowest_, exponent);
  }
  Integer whole(double x) const {
    int exponent = 0;
    Integer result(split(x, exponent));
    if (result.sign() != 0) result <<= static_cast<std::size_t>(exponent - lowest_);
    return result;
  }

  int lowest_ = std::numeric_limits<int>::max();
};

/// The finalizer of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014), whose bits depend on all bits of x.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// Component of w_k, up to 2^62.
Integer direction(std::uint64_t bead, std::uint64_t axis) {
  return Integer(static_cast<std::int64_t>(mix(mix(bead) ^ axis)) / 2);
}

using PolynomialVector = std::array<Polynomial, 3>;

PolynomialVector operator-(const PolynomialVector& a, const PolynomialVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Polynomial cross(const PolynomialVector& a, const PolynomialVector& b, std::size_t axis) {
  const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
  return a[y] * b[z] - a[z] * b[y];
}

/// The motion as polynomials of time.
class ExactMotion {
 public:
  ExactMotion(const PairEnds& ends, bool is_perturbed) {
    const Grid grid(ends);
    std::array<ExactCoordinates, 4> from, to;
    std::size_t bits = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      from[k] = grid.place(ends.from[k], ends.cell_from);
      to[k] = grid.place(ends.to[k], ends.cell_to);
      for (std::size_t axis = 0; axis < 3; ++axis)
        bits = std::max({bits, from[k][axis].bits(), to[k][axis].bits()});
    }
    std::array<PolynomialVector, 4> points;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Integer step = to[k][axis] - from[k][axis];
        if (is_perturbed) {
          const std::size_t shift = std::min(16 * bits + 256, kMaxEpsilonBits) + 64;
          points[k][axis] =
              Polynomial({(from[k][axis] << shift) + direction(ends.beads[k], axis), step << shift});
        } else {
          points[k][axis] = Polynomial({from[k][axis], step});
        }
      }
    }
    p_ = points[1] - points[0];
    q_ = points[3] - points[2];
    between_ = points[2] - points[0];
    for (std::size_t axis = 0; axis < 3; ++axis) f_ = f_ + cross(p_, q_, axis) * between_[axis];
  }

  const Polynomial& f() const { return f_; }

  /// Whether the bonds meet at a root of f; nothing where a bond's end lies on the other, or they are
  /// parallel.
  std::optional<bool> meet_at(const RootInterval& root) const {
    const auto sign = [&](const Polynomial& g) { return TarskiQuery(f_, g).between(root.low, root.high); };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Polynomial whole = cross(p_, q_, axis);
      const int orientation = sign(whole);
      if (orientation == 0) continue;
      bool on_edge = false;
      for (const PolynomialVector& other : {q_, p_}) {
        const Polynomial part = cross(between_, other, axis);
        for (const Polynomial& within : {part, whole - part}) {
          const int side = orientation * sign(within);
          if (side < 0) return false;
          on_edge |= side == 0;
        }
      }
      if (on_edge) return std::nullopt;
      return true;
    }
    return std::nullopt;
  }

  Passage passage_at(RootInterval root) const {
    Passage result;
    result.sign = f_.sign_at(root.high);
    narrow(f_, root, kTimeBits);
    result.time = std::clamp(0.5 * (root.low.value() + root.high.value()), 0.0, 1.0);
    std::size_t largest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
      if (whole_at(root.low, axis).bits() > whole_at(root.low, largest).bits()) largest = axis;
    }
    result.on_p = share(root.low, largest, q_);
    result.on_q = share(root.low, largest, p_);
    return result;
  }

 private:
  Integer whole_at(const Dyadic& t, std::size_t axis) const { return cross(p_, q_, axis).value_at(t, 2); }
  double share(const Dyadic& t, std::size_t axis, const PolynomialVector& other) const {
    const Integer whole = whole_at(t, axis);
    const double part = cross(between_, other, axis).value_at(t, 2).scaled(whole.bits());
    return std::clamp(part / whole.scaled(whole.bits()), 0.0, 1.0);
  }

  PolynomialVector p_, q_, between_;
  Polynomial f_;
};

/// The passages, or nothing where the motion is not generic.
std::optional<std::vector<Passage>> passages_of(const ExactMotion& motion, bool is_perturbed) {
  const Polynomial& f = motion.f();
  std::vector<Passage> found;
  if (f.is_zero()) return std::nullopt;
  const Dyadic zero{Integer(0), 0}, one{Integer(1), 0};
  if (f.sign_at(zero) == 0 || f.sign_at(one) == 0) return std::nullopt;
  const TarskiQuery count(f, Polynomial({Integer(1)}));
  if (count.has_common_factor()) return std::nullopt;
  for (const RootInterval& root : isolate_roots(f, count)) {
    const std::optional<bool> meet = motion.meet_at(root);
    if (!meet && !is_perturbed) return std::nullopt;
    if (meet.value_or(false)) found.push_back(motion.passage_at(root));
  }
  return found;
}

/// Those at one time become their sum.
std::vector<Passage> without_cancelling(const std::vector<Passage>& passages) {
  std::vector<Passage> result;
  for (std::size_t k = 0; k < passages.size();) {
    int sum = 0;
    std::size_t end = k;
    for (; end < passages.size() && passages[end].time - passages[k].time <= kSameTime; ++end)
      sum += passages[end].sign;
    for (std::size_t n = k; n < end; ++n) {
      if (sum != 0 && passages[n].sign == (sum > 0 ? 1 : -1)) {
        result.push_back(passages[n]);
        sum -= passages[n].sign;
      }
    }
    k = end;
  }
  return result;
}

}  // namespace

ExactPassages exact_passages(const PairEnds& ends) {
  if (auto passages = passages_of(ExactMotion(ends, false), false)) return {*std::move(passages), false};
  // A perturbed motion that is not generic all the same stands still, or its bonds have no length.
  const auto passages = passages_of(ExactMotion(ends, true), true);
  return {passages ? without_cancelling(*passages) : std::vector<Passage>(), true};
}

}  // namespace dch::necklace::detail
