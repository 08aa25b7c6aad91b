// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/lists/neighbor_list.hpp>
#include <dch/necklace/crossings.hpp>

#include "crossing/encounter.hpp"
#include "crossing/step_motion.hpp"
#include "crossing/sweep_bounds.hpp"

namespace dch::necklace::detail {

/// What all pairs of a step have in common.
struct StepScene {
  const StepMotion& motion;
  Span<const IndexPair> bonds;
  Span<const Vec3> centers;        ///< of the bonds' sweeps
  Span<const SweepBounds> bounds;  ///< about them
  float largest = 0;               ///< bonds of a larger radius are wide
  std::size_t on_chains = 0;       ///< the first so many bonds have a direction
  double thickness = 0;
};

/// Takes pairs of bonds through the tests, and keeps what it finds.
class PairTests {
 public:
  explicit PairTests(const StepScene& scene) : scene_(scene) {}

  /// Near pairs.
  void take_piece(const NeighborList& piece);
  /// A wide bond and all others, in all images.
  void take_wide(std::int32_t bond);

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
  const SweepBounds& bounds(std::int32_t bond) const { return scene_.bounds[static_cast<std::size_t>(bond)]; }
  bool is_wide(std::int32_t bond) const { return bounds(bond).radius > scene_.largest; }
  /// Of what near pairs are looked at.
  bool is_left_out(std::int32_t bond) const { return bounds(bond).is_left_out() || is_wide(bond); }
  Vec3 center(std::int32_t bond) const { return scene_.centers[static_cast<std::size_t>(bond)]; }

  /// A near pair that was not rejected by its bounds.
  struct Met {
    std::int32_t owner, partner;
    Vec3 between;
  };
  void ask_for(std::int32_t bond) const;
  void meet(std::int32_t owner, std::int32_t partner);
  void take_met();
  /// By what is known without a look at the beads.
  bool rejects(std::int32_t p, std::int32_t q, Vec3 between);
  /// Of two bonds in either order.
  void take_either(const Bond& a, const Bond& b, Vec3 between) {
    a.index < b.index ? take(a, b, between) : take(b, a, -1 * between);
  }
  /// @param between from the center of p to that of the image of q that is meant
  void take(const Bond& p, const Bond& q, Vec3 between);
  void take_near(const Bond& p, const Bond& q, const Image& image);
  void note(const Bond& p, const Bond& q, const BondEncounter& encounter);

  const StepScene& scene_;
  std::vector<Met> met_;
};

}  // namespace dch::necklace::detail
