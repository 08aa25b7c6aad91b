// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/necklace/chains.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// Positions that break what a theorem on necklaces assumes. The message names the beads, the value measured
/// and the limit.
class NotANecklace : public Error {
 public:
  using Error::Error;
};

/// The constants in the assumptions of section 4.3 of the thesis, as measured. Pairs are particle indices;
/// without a bond they are {-1, -1}.
struct NecklaceMeasure {
  /// Uniformity: largest radius over smallest, >= 1; infinite if some radii are 0 and others are not.
  double alpha = 1;
  /// Limited overlap: the smallest angle between the outward normals of two bonded beads where their surfaces
  /// meet [rad]; pi if none overlap, 0 if one lies inside the other.
  double beta = 0;
  /// Connectivity: the largest gap between the surfaces of bonded beads [length]; at most 0 if the chains are
  /// connected, and 0 without a bond.
  double largest_gap = 0;
  double shortest_bond = 0, longest_bond = 0;  ///< distances of the centers of bonded beads [length]
  IndexPair deepest_overlap{-1, -1};           ///< the bond that beta is of
  IndexPair widest_gap{-1, -1};                ///< the bond that largest_gap is of
};

/// What a caller asks of the constants; the defaults accept every chain.
struct NecklaceLimits {
  double max_alpha = kAnything;
  double min_beta = 0;                ///< [rad]
  double max_gap = kAnything;         ///< [length]; 0 asks for connected chains
  double max_bond_ratio = kAnything;  ///< longest bond over shortest, >= 1

  static constexpr double kAnything = 1e300;
};

/// Beads with radii along open and closed chains: what does not change while the chains move.
///
/// Beads are particle indices, as in Chains. Their *places* number the beads of all chains one after the
/// other, chain by chain in order along each: a subchain is a range of places. Particles in no chain have no
/// place.
class Necklace {
 public:
  Necklace() = default;
  /// @param radii one for each particle [length], 0 for points
  /// @throws InvalidParameter for another number of radii than chains.particles(), and for a radius that is
  ///   negative, not finite or above kMaxCoordinate.
  Necklace(Chains chains, std::vector<double> radii);
  /// The same radius for all.
  Necklace(const Chains& chains, double radius);
  /// One chain of all particles in order of index.
  /// @throws InvalidParameter as above, and for a ring of fewer than three beads.
  static Necklace chain(std::vector<double> radii, bool closed = false);

  const Chains& chains() const { return chains_; }
  std::size_t particles() const { return chains_.particles(); }
  /// Number of beads, which is that of places.
  std::size_t size() const { return particle_.size(); }
  /// By particle [length].
  Span<const double> radii() const { return radii_; }
  double radius(std::int32_t particle) const { return radii_[static_cast<std::size_t>(particle)]; }
  /// Of the beads; 0 without a bead [length].
  double largest_radius() const { return largest_radius_; }

  /// The particles by place.
  Span<const std::int32_t> particle() const { return particle_; }
  /// First place of a chain; first_place(chains().size()) is size().
  std::int32_t first_place(std::size_t chain) const { return first_place_[chain]; }

  /// How many bonds lie between two places of one chain, around a ring the shorter way; -1 for places of
  /// different chains.
  std::int32_t bonds_between(std::int32_t place, std::int32_t other) const;
  /// The chain in which a place lies.
  std::size_t chain_at(std::int32_t place) const {
    return static_cast<std::size_t>(chains_.chain_of(particle_[static_cast<std::size_t>(place)]));
  }

  /// Measures the constants at these positions; bonds are nearest images. O(n).
  /// @throws InvalidParameter for another number of positions than particles(), InvalidPosition for a bead
  ///   whose position is not finite or beyond kMaxCoordinate.
  NecklaceMeasure measure(Span<const Vec3> positions, const Box& box) const;

 private:
  Chains chains_;
  std::vector<double> radii_;
  std::vector<std::int32_t> particle_;
  std::vector<std::int32_t> first_place_{0};
  double largest_radius_ = 0;
};

/// Refuses chains that break a limit.
/// @throws NotANecklace.
void require(const NecklaceMeasure& measure, const NecklaceLimits& limits);

}  // namespace dch::necklace
#pragma GCC visibility pop
