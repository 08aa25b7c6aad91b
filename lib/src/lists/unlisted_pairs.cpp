// SPDX-License-Identifier: MIT
#include "lists/unlisted_pairs.hpp"

#include <algorithm>

namespace dch::detail {
namespace {

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

Crescent UnlistedPairs::crescent_of(const MovedParticle& fast) const {
  const auto i = static_cast<std::size_t>(fast.particle);
  const Vec3 now = question_.positions[i];
  const Cutoffs cutoffs = cutoffs_of(fast.particle);
  // Of the place then, the place now, and the way between them.
  const double off = error_ + 4 * wrap_error_.bound(wrap_error_.reach(now) + wrap_error_.reach(before_[i]));
  return {fast.particle, box_.wrap(before_[i]), box_.wrap(now), cutoffs.least + skin_ - off,
          cutoffs.largest < 0 ? -1 : cutoffs.largest + fast.moved + off};
}

}  // namespace dch::detail
