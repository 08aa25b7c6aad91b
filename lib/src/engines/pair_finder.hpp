// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <dch/engines/neighbor_pairs.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/list_params.hpp>

#include "engines/cell_images.hpp"
#include "engines/ghost_points.hpp"

namespace dch::detail {

/// Checks what neighbor_pairs() is asked, and has an engine find it: in the periodic box where each pair has
/// one image within reach, else in open space among particles and ghosts.
class PairFinder {
 public:
  /// @throws as neighbor_pairs(). What is given must outlive this.
  PairFinder(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params);

  /// What the engine finds: rows of particles, neighbors of which may be ghosts. Those of ghosts are in full
  /// lists alone, whatever kind of pairs is asked for, and without regard to exclusions.
  NeighborList find(ListKind kind, RowOrder order) const;
  /// About how many pairs there are.
  double expected() const;

  Span<const Vec3> given() const { return given_; }
  const Box& box() const { return box_; }
  const NeighborPairsParams& params() const { return params_; }
  const HomeImages& home() const { return *home_; }
  HomeImages take_home() { return std::move(*home_); }
  /// Whether the image of a pair within reach is that which PairGeometry finds, in spite of rounding.
  bool has_rounded_images() const;
  /// Null where each pair has one image within reach.
  const GhostPoints* ghosts() const { return ghosts_ ? &*ghosts_ : nullptr; }

 private:
  const std::vector<Vec3>& points() const { return ghosts_ ? ghosts_->positions() : home_->positions; }
  void check_expected() const;
  std::unique_ptr<PairSearch> engine(double radius) const;

  Span<const Vec3> given_;
  const Box& box_;
  const NeighborPairsParams& params_;
  ListParams request_;
  double radius_ = 0, reach_ = 0;
  std::optional<HomeImages> home_;
  std::optional<GhostPoints> ghosts_;  ///< where several images of a particle may be in reach
};

/// Takes what the finder holds.
NeighborPairs pairs_of(PairFinder& finder);

/// As expected_pairs().
double expected_pairs_of(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params);

}  // namespace dch::detail
