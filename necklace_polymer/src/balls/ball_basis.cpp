// SPDX-License-Identifier: MIT
// Minimum enclosing balls of at most five balls.
#include "balls/ball_basis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dch::necklace::detail {

namespace {

/// Up to five balls, and where they come from.
struct Few {
  std::array<const Ball*, 5> ball{};
  std::array<std::int32_t, 5> index{};
  int size = 0;
  bool even = true;  ///< all radii are the same

  void add(Span<const Ball> balls, std::int32_t k) {
    const Ball& added = balls[static_cast<std::size_t>(k)];
    ball[static_cast<std::size_t>(size)] = &added;
    index[static_cast<std::size_t>(size++)] = k;
    even = even && added.radius == ball[0]->radius;
  }
  void remove(int k) {
    std::copy(ball.begin() + k + 1, ball.begin() + size, ball.begin() + k);
    std::copy(index.begin() + k + 1, index.begin() + size, index.begin() + k);
    --size;
  }
  const Ball& operator[](int k) const { return *ball[static_cast<std::size_t>(k)]; }
};

/// Centers of balls that some balls touch from within, at most two, and, if that is asked, whether the first
/// lies in the convex hull of theirs: then it is the center of their minimum enclosing ball.
struct Touching {
  std::array<Vec3, 2> center;
  int count = 0;
  bool central = false;
  int weakest = 0;  ///< which of the balls has the least weight in the first center
};

Touching touching_two(const Ball& a, const Ball& b) {
  const Vec3 d = b.center - a.center;
  const double length = std::sqrt(norm2(d));
  const double excess = b.radius - a.radius;
  if (!(length > std::abs(excess))) return {{}, 0, false, excess > 0 ? 0 : 1};  // one lies in the other
  return {{a.center + (0.5 * (1 + excess / length)) * d, {}}, 1, true, 0};
}

/// The first center is that of the first ball + q: finds the weights of the balls' centers in it.
void weigh(Touching& result, Vec3 q, const std::array<Vec3, 3>& dual, int others) {
  double first = 1, min_weight = INFINITY;
  for (int k = 0; k < others; ++k) {
    const double weight = dot(q, dual[static_cast<std::size_t>(k)]);
    first -= weight;
    if (weight < min_weight) min_weight = weight, result.weakest = k + 1;
  }
  if (first < min_weight) result.weakest = 0;
  result.central = std::min(first, min_weight) >= 0;
}

/// For three or four balls: with q the center relative to that of the first ball, s the radius less the
/// first's, d_i the center of another ball relative to the first and f_i its radius less the first's,
///     |q| = s,  d_i . q = (|d_i|^2 - f_i^2)/2 + s f_i,
/// so q = u + s v in the basis dual to d_i, which leaves a quadratic equation for s. Equal radii have v = 0.
template <bool kWeigh>
Touching touching_more(Vec3 origin, const std::array<Vec3, 3>& d, const std::array<double, 3>& f,
                       const std::array<Vec3, 3>& dual, int others) {
  Vec3 u, v;
  double min_s = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(others); ++k) {
    u = u + (0.5 * (norm2(d[k]) - f[k] * f[k])) * dual[k];
    v = v + f[k] * dual[k];
    min_s = std::max(min_s, f[k]);
  }
  Touching result;
  if (f[0] == 0 && f[1] == 0 && f[2] == 0) {
    result.center[static_cast<std::size_t>(result.count++)] = origin + u;
    if (kWeigh) weigh(result, u, dual, others);
    return result;
  }
  const double a = norm2(v) - 1, b = dot(u, v), c = norm2(u);
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0)) return {};
  const double root = std::sqrt(discriminant);
  const double sum = b >= 0 ? -(b + root) : root - b;  // the one without cancellation
  const std::array<double, 2> solutions{sum / a, c / sum};
  for (const double s : solutions) {
    if (!(s >= min_s && std::isfinite(s))) continue;
    const Vec3 q = u + s * v;
    if (kWeigh && result.count == 0) weigh(result, q, dual, others);
    result.center[static_cast<std::size_t>(result.count++)] = origin + q;
  }
  return result;
}

template <bool kWeigh>
Touching touching(const std::array<const Ball*, 4>& balls, int size) {
  const Ball& first = *balls[0];
  if (size == 1) return {{first.center, {}}, 1, true, 0};
  if (size == 2) return touching_two(first, *balls[1]);
  std::array<Vec3, 3> d, dual;
  std::array<double, 3> f{};
  for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(size); ++k) {
    d[k] = balls[k + 1]->center - first.center;
    f[k] = balls[k + 1]->radius - first.radius;
  }
  if (size == 3) {
    const Vec3 normal = cross(d[0], d[1]);
    const double area2 = norm2(normal);
    if (!(area2 > 0)) return {};
    dual = {(1 / area2) * cross(d[1], normal), (1 / area2) * cross(normal, d[0]), {}};
  } else {
    const Vec3 c12 = cross(d[1], d[2]);
    const double volume = dot(d[0], c12);
    if (volume == 0) return {};
    dual = {(1 / volume) * c12, (1 / volume) * cross(d[2], d[0]), (1 / volume) * cross(d[0], d[1])};
  }
  return touching_more<kWeigh>(first.center, d, f, dual, size - 1);
}

int members_in(unsigned subset) {
  int count = 0;
  for (; subset != 0; subset &= subset - 1) ++count;
  return count;
}

/// Picks the members of `few` whose bit is set; at most four bits are.
std::array<const Ball*, 4> members(const Few& few, unsigned subset) {
  std::array<const Ball*, 4> result{};
  int size = 0;
  for (unsigned k = 0; k < static_cast<unsigned>(few.size); ++k) {
    if (subset >> k & 1) result[static_cast<std::size_t>(size++)] = few.ball[k];
  }
  return result;
}

EnclosingBall named(const Few& few, unsigned subset, const Ball& ball) {
  EnclosingBall result{ball, {}};
  auto& indices = result.basis.members;
  for (unsigned k = 0; k < static_cast<unsigned>(few.size); ++k) {
    if (!(subset >> k & 1)) continue;
    auto slot = static_cast<std::size_t>(result.basis.size++);
    for (; slot > 0 && indices[slot - 1] > few.index[k]; --slot) indices[slot] = indices[slot - 1];
    indices[slot] = few.index[k];
  }
  return result;
}

double reach(const Few& few, Vec3 center) {
  double largest = 0;
  if (few.even) {
    for (int k = 0; k < few.size; ++k) largest = std::max(largest, norm2(few[k].center - center));
    return std::sqrt(largest) + few[0].radius;
  }
  for (int k = 0; k < few.size; ++k) largest = std::max(largest, far_side(center, few[k]));
  return largest;
}

/// Whatever the center, the ball around it that reaches the farthest side encloses all; the minimum one is
/// the least of these. So of the balls that subsets touch the one of least reach is the answer, and no
/// tolerance decides. Subsets have to hold all of `required`; smaller ones come first and win ties.
EnclosingBall smallest_of(const Few& few, unsigned required) {
  double best = INFINITY;
  EnclosingBall result;
  for (int size = 1; size <= std::min(few.size, 4); ++size) {
    for (unsigned subset = 1; subset < 1U << few.size; ++subset) {
      if (members_in(subset) != size || (subset & required) != required) continue;
      const Touching found = touching<false>(members(few, subset), size);
      for (std::size_t k = 0; k < static_cast<std::size_t>(found.count); ++k) {
        const double radius = reach(few, found.center[k]);
        if (!(radius < best * (1 - 1e-15))) continue;
        best = radius;
        result = named(few, subset, {found.center[k], radius});
      }
    }
  }
  return result;
}

}  // namespace

EnclosingBall ball_of_basis(Span<const Ball> balls, const Basis& basis) {
  Few few;
  for (const std::int32_t k : basis.indices()) few.add(balls, k);
  // Most often all are needed, else all but the one of least weight. A ball that rests on some of them and
  // encloses all is the one.
  for (Few part = few; part.size > 0;) {
    const Touching found =
        touching<true>({part.ball[0], part.ball[1], part.ball[2], part.ball[3]}, part.size);
    if (found.count == 1 && found.central) {
      const double radius = reach(few, found.center[0]);
      if (part.size < few.size && radius > reach(part, found.center[0])) break;
      return named(part, (1U << part.size) - 1, {found.center[0], radius});
    }
    part.remove(found.weakest);
  }
  return smallest_of(few, 0);
}

EnclosingBall exchange(Span<const Ball> balls, const Basis& basis, std::int32_t entering) {
  Few few;
  few.add(balls, entering);
  for (const std::int32_t k : basis.indices()) few.add(balls, k);
  return smallest_of(few, 1);
}

}  // namespace dch::necklace::detail
