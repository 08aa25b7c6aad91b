// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/unlisted_pair.hpp>

#include "geometry/position_check.hpp"
#include "lists/pair_filter.hpp"

namespace dch::detail {

/// Where particles were that a fast one may have come within its cutoff of, though the list lacks the pair.
///
/// Let i be the one of the two that has moved farther, or as far. The other one has moved by `moved` of i at
/// most, so it was within cutoff + moved of where i is now; and it was beyond cutoff + skin of where i was.
/// What is left between the two spheres is thin and lies ahead of i: if i has moved by half the skin and no
/// more, they touch in a point.
struct Crescent {
  std::int32_t particle;
  Vec3 now;        ///< where the particle is, wrapped
  Vec3 middle;     ///< of a ball that holds the crescent, wrapped
  double radius;   ///< of the ball; negative if the crescent is empty [length]
  Vec3 from_now;   ///< from `now` to the middle
  Vec3 from_then;  ///< from where the particle was to the middle
  double inner;    ///< the list has all that were within this of where it was; negative if none [length]
  double outer;    ///< the others were within this of `now` [length]
};

/// Decides pair by pair, by the definition of ListParams and no other, whether a pair is within its cutoff
/// now and was beyond its cutoff + skin then.
class UnlistedPairs {
 public:
  /// Whether a question can be answered by the definition: not where a host decides about some pairs.
  static bool can_tell(const UnlistedQuestion& question) { return question.params.tie_breaker == nullptr; }

  /// @param before positions as given for the list, which with what the question points to must outlive this
  /// @param error how far distances of wrapped positions then may be from pair distances [length]
  UnlistedPairs(const UnlistedQuestion& question, Span<const Vec3> before, const Box& box, double error);

  bool contains(std::int32_t i, std::int32_t j) const {
    return i != j && now_.accept(i, j) && !listed_.accept(i, j);
  }

  /// Calls any(crescent) for the fast particles, until it says that a pair is in this one.
  template <class Any>
  UnlistedPair find(const Any& any) const {
    for (const MovedParticle& fast : question_.fast) {
      const Crescent crescent = crescent_of(fast);
      if (crescent.radius >= 0 && any(crescent)) return UnlistedPair::found;
    }
    return UnlistedPair::none;
  }

 private:
  struct Cutoffs {
    double least, largest;  ///< that a particle has with any other; none if the largest is negative [length]
  };
  Cutoffs cutoffs_of(std::int32_t i) const;
  /// That of a fast particle and all others.
  Crescent crescent_of(const MovedParticle& fast) const;

  const UnlistedQuestion& question_;
  Span<const Vec3> before_;
  const Box& box_;
  WrapError wrap_error_;
  double error_, skin_;
  PairFilter listed_, now_;
  std::vector<Cutoffs> by_type_;
};

}  // namespace dch::detail
