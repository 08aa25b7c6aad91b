// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/zonotope/face_walk.hpp>

#include "hull_tree.hpp"
#include "membership_question.hpp"
#include "predicates.hpp"
#include "vectors.hpp"

namespace dch::zonotope {
namespace {

constexpr std::size_t kNone = HullTree::kNone;

/// A turn by no simple angles, so that hardly any generator lies in the plane at infinity.
Vec3 turned(Vec3 v) {
  const double c = std::cos(1.1), s = std::sin(1.1), d = std::cos(0.6), t = std::sin(0.6);
  const Vec3 w{c * v.x - s * v.y, s * v.x + c * v.y, v.z};
  return {w.x, d * w.y - t * w.z, t * w.y + d * w.z};
}

}  // namespace

struct FaceWalk::Impl {
  /// The hulls of the generators on one side of the facet's plane.
  struct Side {
    HullTree lower, upper;

    explicit Side(Span<const Vec2> points) : lower(points, false), upper(points, true) {}
    void insert(std::size_t k) { lower.insert(k), upper.insert(k); }
    void erase(std::size_t k) { lower.erase(k), upper.erase(k); }
  };

  Zonotope z;
  std::vector<Vec3> vectors;       ///< the generators turned, those with z < 0 reversed, by x of the points
  std::vector<Vec2> points;        ///< x/z and y/z
  std::vector<std::size_t> given;  ///< their numbers in z
  std::vector<int> side;           ///< of the normal: 1, -1; 0 for the two of the facet
  std::vector<Side> sides;         ///< those with side 1 and -1
  std::size_t i = kNone, j = kNone;
  Vec3 normal;    ///< turned
  Vec3 gradient;  ///< sum of side times vector
  FaceWalkStats stats;

  explicit Impl(const Zonotope& given_zonotope);
  void locate(Vec3 x);
  void take_facet(std::size_t first, std::size_t second, Vec3 x);
  bool step(Vec3 x);
  std::size_t next_around(std::size_t pivot, bool is_rising) const;
  bool go(std::size_t pivot, std::size_t other, Vec3 along, Vec3 x);
  void turn_over();
};

FaceWalk::Impl::Impl(const Zonotope& given_zonotope) : z(canonical(given_zonotope)) {
  const std::size_t n = z.generators.size();
  std::vector<Vec3> all;
  for (const Vec3& v : z.generators) {
    const Vec3 w = turned(v);
    all.push_back(w.z < 0 ? -1.0 * w : w);
    if (all.back().z == 0) all.back().z = 1e-16 * std::sqrt(norm2(w));
  }
  given.resize(n);
  for (std::size_t k = 0; k < n; ++k) given[k] = k;
  std::sort(given.begin(), given.end(),
            [&](std::size_t a, std::size_t b) { return all[a].x * all[b].z < all[b].x * all[a].z; });
  for (const std::size_t k : given) {
    vectors.push_back(all[k]);
    points.push_back({all[k].x / all[k].z, all[k].y / all[k].z});
  }
  side.assign(n, 0);
  sides.emplace_back(points);
  sides.emplace_back(points);
}

/// Everything anew, for the facet of two generators.
void FaceWalk::Impl::take_facet(std::size_t first, std::size_t second, Vec3 x) {
  i = first;
  j = second;
  normal = dch::cross(vectors[i], vectors[j]);
  if (dch::dot(normal, x) < 0) normal = -1.0 * normal;
  gradient = {};
  std::array<std::vector<bool>, 2> is_in{std::vector<bool>(vectors.size()),
                                         std::vector<bool>(vectors.size())};
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    side[k] = k == i || k == j ? 0 : dch::dot(normal, vectors[k]) >= 0 ? 1 : -1;
    gradient = gradient + side[k] * vectors[k];
    if (side[k] != 0) is_in[side[k] > 0 ? 0 : 1][k] = true;
  }
  for (const std::size_t s : {0u, 1u}) {
    sides[s].lower.assign(is_in[s]);
    sides[s].upper.assign(is_in[s]);
  }
}

/// By point location.
void FaceWalk::Impl::locate(Vec3 x) {
  ++stats.searches;
  Question question;
  question.generators = vectors;
  question.point = x;
  const MetFacet met = facet_towards(question);
  if (met.i == SIZE_MAX || met.j == SIZE_MAX || met.i == met.j || !(met.support > 0))
    throw InvalidParameter(
        "the " + std::to_string(vectors.size()) +
        " generators of a zonotope do not span space, so that no facet is met; use norm()");
  take_facet(met.i, met.j, x);
}

/// The generator that the line through a point meets next as it turns. Those to the right of the point are
/// met from below, those to the left from above if it rises; past the vertical, the other way around.
std::size_t FaceWalk::Impl::next_around(std::size_t pivot, bool is_rising) const {
  const bool positive_is_above = normal.y > 0;
  const Side& above = sides[positive_is_above ? 0 : 1];
  const Side& below = sides[positive_is_above ? 1 : 0];
  const auto pick = [&](const Side& right, const Side& left) {
    const std::size_t a =
        (is_rising ? right.lower : right.upper).first_met(pivot, pivot + 1, points.size(), is_rising);
    const std::size_t b = (is_rising ? left.upper : left.lower).first_met(pivot, 0, pivot, is_rising);
    if (a == kNone || b == kNone) return a == kNone ? b : a;
    const double turn = cross(points[a] - points[pivot], points[pivot] - points[b]);
    return (is_rising ? turn < 0 : turn > 0) ? b : a;
  };
  const std::size_t before_vertical = is_rising ? pick(above, below) : pick(below, above);
  if (before_vertical != kNone) return before_vertical;
  return is_rising ? pick(below, above) : pick(above, below);
}

bool FaceWalk::Impl::go(std::size_t pivot, std::size_t other, Vec3 along, Vec3 x) {
  const std::size_t next = next_around(pivot, normal.x * along.y - along.x * normal.y > 0);
  if (next == kNone) return false;
  ++stats.steps;
  const int left_to = dch::dot(vectors[other], along) >= 0 ? 1 : -1;
  sides[side[next] > 0 ? 0 : 1].erase(next);
  sides[left_to > 0 ? 0 : 1].insert(other);
  gradient = gradient - side[next] * vectors[next] + left_to * vectors[other];
  side[other] = left_to;
  side[next] = 0;
  i = pivot;
  j = next;
  normal = dch::cross(vectors[i], vectors[j]);
  if (dch::dot(normal, x) < 0) normal = -1.0 * normal;
  return true;
}

/// To a facet beside this one where h(n) / (n . x) is less; false if it is least here.
bool FaceWalk::Impl::step(Vec3 x) {
  const std::size_t pivots[2] = {i, j};
  const double scale = 1e-14 * (std::abs(gradient.x) + std::abs(gradient.y) + std::abs(gradient.z));
  for (const std::size_t which : {0u, 1u}) {
    const std::size_t pivot = pivots[which], other = pivots[1 - which];
    const Vec3 across = dch::cross(vectors[pivot], x);
    const double fixed = std::abs(dch::dot(vectors[other], across)), rate = dch::dot(gradient, across);
    const Vec3 m = magnitudes(across);
    if (std::abs(rate) <= fixed + scale * (m.x + m.y + m.z)) continue;
    return go(pivot, other, rate < 0 ? across : -1.0 * across, x);
  }
  return false;
}

/// To the opposite facet.
void FaceWalk::Impl::turn_over() {
  normal = -1.0 * normal;
  gradient = -1.0 * gradient;
  for (int& s : side) s = -s;
  std::swap(sides[0], sides[1]);
}

FaceWalk::FaceWalk(const Zonotope& z) : impl_(std::make_unique<Impl>(z)) {
  if (!span_space(impl_->z.generators))
    throw InvalidParameter(std::to_string(impl_->vectors.size()) +
                           " generators do not span space, so that there are no facets to walk; use norm()");
  impl_->locate(impl_->vectors[0] + 0.7 * impl_->vectors[1] + 0.4 * impl_->vectors[2]);
}
FaceWalk::FaceWalk(FaceWalk&&) noexcept = default;
FaceWalk& FaceWalk::operator=(FaceWalk&&) noexcept = default;
FaceWalk::~FaceWalk() = default;

double FaceWalk::move_to(Vec3 point) {
  check(Zonotope{point, {}});
  Impl& walk = *impl_;
  const Vec3 x = turned(point - walk.z.center);
  if (x == Vec3{}) return 0;
  double height = dch::dot(walk.normal, x);
  if (height < 0) walk.turn_over();
  const auto most = static_cast<std::int64_t>(8 * walk.vectors.size() + 64);
  const std::int64_t start = walk.stats.steps;
  if (height == 0) walk.locate(x);
  while (walk.step(x)) {
    if (walk.stats.steps - start < most) continue;
    walk.locate(x);
    break;
  }
  height = dch::dot(walk.normal, x);
  return height / dch::dot(walk.normal, walk.gradient);
}

Vec3 FaceWalk::normal() const {
  const Vec3 normal =
      dch::cross(impl_->z.generators[first_generator()], impl_->z.generators[second_generator()]);
  return dch::dot(turned(normal), impl_->normal) < 0 ? -1.0 * normal : normal;
}
const Zonotope& FaceWalk::zonotope() const { return impl_->z; }
std::size_t FaceWalk::first_generator() const { return impl_->given[impl_->i]; }
std::size_t FaceWalk::second_generator() const { return impl_->given[impl_->j]; }

const FaceWalkStats& FaceWalk::stats() const {
  impl_->stats.operations = 0;
  for (const Impl::Side& side : impl_->sides)
    impl_->stats.operations += side.lower.operations() + side.upper.operations();
  return impl_->stats;
}

}  // namespace dch::zonotope
