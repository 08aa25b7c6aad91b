// SPDX-License-Identifier: MIT
#include "lists/unlisted_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

double sum_of(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

ListParams without_skin(const ListParams& params) {
  ListParams bare = params;
  bare.skin = bare.shell = 0;
  return bare;
}

}  // namespace

UnlistedPairs::UnlistedPairs(const UnlistedQuestion& question, Span<const Vec3> before, const Box& box,
                             double error)
    : question_(question),
      before_(before),
      box_(box),
      wrap_error_(box),
      error_(error),
      skin_(question.params.skin),
      listed_(before, box, question.params, error, question.radii),
      now_(question.positions, box, without_skin(question.params), error, question.radii) {
  const TypeCutoffs& cutoffs = question.params.cutoffs;
  for (int a = 0; a < cutoffs.types() && question.params.radii.empty(); ++a) {
    Cutoffs own{cutoffs.largest(), -1};
    for (int b = 0; b < cutoffs.types(); ++b) {
      if (cutoffs(a, b) == 0) continue;
      own.least = std::min(own.least, cutoffs(a, b));
      own.largest = std::max(own.largest, cutoffs(a, b));
    }
    by_type_.push_back(own);
  }
}

UnlistedPairs::Cutoffs UnlistedPairs::cutoffs_of(std::int32_t i) const {
  const ListParams& params = question_.params;
  if (!params.radii.empty())
    return {params.radii[i] + question_.radii.least, params.radii[i] + question_.radii.largest};
  return by_type_[params.types.empty() ? 0 : static_cast<std::size_t>(params.types[i])];
}

// With the way u from then to now, a point p of the crescent, as seen from then, has |p| > inner and
// |p - u| <= outer, hence p.u >= (inner^2 + u^2 - outer^2) / 2: it is in a cap of the outer sphere, whose
// plane is `ahead` of its center. The ball around the plane's part of the sphere holds the cap.
Crescent UnlistedPairs::crescent_of(const MovedParticle& fast) const {
  const auto i = static_cast<std::size_t>(fast.particle);
  const Vec3 now = question_.positions[i];
  const Cutoffs cutoffs = cutoffs_of(fast.particle);
  // Of the place then, the place now, and the way between them.
  const double off = error_ + 4 * wrap_error_.bound(wrap_error_.reach(now) + wrap_error_.reach(before_[i]));
  Crescent crescent{};
  crescent.particle = fast.particle;
  crescent.now = crescent.middle = box_.wrap(now);
  crescent.from_then = box_.nearest_image(crescent.now - box_.wrap(before_[i]));
  crescent.inner = cutoffs.least + skin_ - off;
  crescent.outer = crescent.radius = cutoffs.largest < 0 ? -1 : cutoffs.largest + fast.moved + off;
  const double way = std::sqrt(norm2(crescent.from_then)), inner = crescent.inner, outer = crescent.outer;
  if (outer < 0 || inner < 0 || way == 0) return crescent;
  constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
  const double ahead =
      ((inner * inner - outer * outer) - kRounding * (inner * inner + outer * outer)) / (2 * way) - 0.5 * way;
  if (ahead <= 0) return crescent;
  const double radius2 = outer * outer * kInflate - ahead * ahead;
  crescent.radius = radius2 < 0 ? -1 : std::sqrt(radius2) * kInflate + off;
  crescent.from_now = (ahead / way) * crescent.from_then;
  crescent.from_then = crescent.from_then + crescent.from_now;
  crescent.middle = box_.wrap(crescent.now + crescent.from_now);
  // The middle is no place that was given: far from the origin its coordinates round by more than the places
  // of two particles near each other differ.
  const double rounding = kRounding * (sum_of(crescent.now) + sum_of(crescent.from_now));
  crescent.inner -= rounding;
  crescent.outer += rounding;
  if (crescent.radius >= 0) crescent.radius += rounding;
  return crescent;
}

}  // namespace dch::detail
