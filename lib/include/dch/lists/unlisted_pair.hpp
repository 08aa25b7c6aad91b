// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/stale_test.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// A question about a list that was made a while ago: whether a pair has come within its cutoff that was
/// beyond its cutoff + skin then, so that the list lacks it.
struct UnlistedQuestion {
  const ListParams& params;          ///< of the list
  RadiusRange radii;                 ///< of params.radii
  Span<const Vec3> positions;        ///< of the particles now, in the box of the list
  Span<const MovedParticle> fast{};  ///< all that have moved by more than half the skin: StaleTest::judge()
};

/// The answer.
enum class UnlistedPair {
  none,    ///< the list holds every pair within its cutoff
  found,   ///< there is such a pair
  unknown  ///< the engine cannot tell
};

}  // namespace dch
#pragma GCC visibility pop
