// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/necklace/chain_trees.hpp>
#include <dch/necklace/enclosing_ball.hpp>
#include <dch/necklace/necklace.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// A hierarchy of bounding spheres over chains of beads: a *cage* for each node of the trees along the
/// chains, which encloses the beads below it. What the hierarchies of the thesis have in common, and what
/// contacts are searched with (contacts.hpp).
///
/// In a periodic box chains are made whole along their bonds first, so cages are balls of the plain space and
/// may be larger than the box.
class CageHierarchy {
 public:
  const Necklace& necklace() const { return necklace_; }
  const ChainTrees& trees() const { return trees_; }
  const Box& box() const { return box_; }
  /// By place; chains are whole. Empty before the first update, and after one that threw.
  Span<const Ball> beads() const { return beads_; }
  /// By node of trees(). Each encloses the beads of its node within 1e-11 of its radius.
  Span<const Ball> cages() const { return cages_; }
  /// By place, as they were given [length].
  Span<const Vec3> positions() const { return positions_; }
  /// Bound on how far rounding of coordinates can put the distance of two images off [length].
  double rounding() const { return rounding_; }
  std::size_t memory_bytes() const;

 protected:
  CageHierarchy(Necklace necklace, int leaf_beads);
  ~CageHierarchy() = default;
  CageHierarchy(const CageHierarchy&) = default;
  CageHierarchy(CageHierarchy&&) = default;
  CageHierarchy& operator=(const CageHierarchy&) = default;
  CageHierarchy& operator=(CageHierarchy&&) = default;

  /// Takes positions into beads(); nothing is held if it throws. Into `moved2`, if there is one, goes by
  /// place the squared distance of each bead from where it was [length^2].
  /// @throws InvalidParameter, InvalidPosition, Undetermined.
  void take(Span<const Vec3> positions, const Box& box, std::vector<double>* moved2 = nullptr);
  void forget();  ///< what take() took; takes no memory
  std::vector<Ball>& mutable_cages() { return cages_; }

 private:
  void place_beads(Span<const Vec3> positions, Span<const Vec3> placed, std::vector<double>* moved2);

  Necklace necklace_;
  ChainTrees trees_;
  Box box_;
  std::vector<Ball> beads_, cages_;
  std::vector<Vec3> positions_;
  double rounding_ = 0;
};

}  // namespace dch::necklace
#pragma GCC visibility pop
