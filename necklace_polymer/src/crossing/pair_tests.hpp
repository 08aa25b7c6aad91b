// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/necklace/crossings.hpp>

#include "crossing/encounter.hpp"
#include "crossing/near_midpoints.hpp"
#include "crossing/step_motion.hpp"

namespace dch::necklace::detail {

/// What all pairs of a step have in common.
struct StepScene {
  const StepMotion& motion;
  Span<const IndexPair> bonds;
  Span<const Vec3> centers;   ///< of the bonds' sweeps
  Span<const float> radii;    ///< of balls around them; below 0 where a bond is left out
  std::size_t on_chains = 0;  ///< the first so many bonds have a direction
  double thickness = 0;
};

/// Takes pairs of bonds through the tests, and keeps what it finds.
class PairTests {
 public:
  explicit PairTests(const StepScene& scene) : scene_(scene) {}

  /// The near pairs of some rows.
  void take_rows(const NearMidpoints& near, std::size_t first, std::size_t last);
  /// A wide bond and all others, in all images.
  void take_wide(const NearMidpoints& near, std::int32_t bond);

  StepCrossings found;

 private:
  struct Bond {
    std::int32_t index;
    BondStep step;
    BondSweep sweep;
  };
  Bond bond_at(std::int32_t index) const {
    const BondStep step = scene_.motion.bond(scene_.bonds[static_cast<std::size_t>(index)]);
    return {index, step, BondSweep(step.ends)};
  }
  bool share_bead(std::int32_t a, std::int32_t b) const;
  float radius(std::int32_t bond) const { return scene_.radii[static_cast<std::size_t>(bond)]; }
  Vec3 center(std::int32_t bond) const { return scene_.centers[static_cast<std::size_t>(bond)]; }

  /// @param between from the center of p to that of the image of q that is meant
  void take(const Bond& p, const Bond& q, Vec3 between);
  void take_near(const Bond& p, const Bond& q, const Image& image);
  void note(const Bond& p, const Bond& q, const BondEncounter& encounter);

  const StepScene& scene_;
};

}  // namespace dch::necklace::detail
