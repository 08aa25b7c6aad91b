// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// The periodic images of the beads do not tell where a chain goes. The message names the bond, its length
/// and the limit. It is never replaced by a guess: a wrong guess would report a knot that is not there.
class Undetermined : public Error {
 public:
  Undetermined(const std::string& message, IndexPair bond) : Error(message), bond_(bond) {}
  /// The bond, as particle indices; of a ring that winds around the box its closing bond, {last, first}.
  IndexPair bond() const { return bond_; }

 private:
  IndexPair bond_;
};

/// Necklaces: each chain is a sequence of beads in which consecutive ones are bonded; a closed chain (a ring)
/// bonds its last bead to its first as well. Beads are particle indices in [0, particles()); each stands in
/// at most one chain, and a particle may stand in none (solvent).
class Chains {
 public:
  Chains() = default;

  /// Chains from a set of bonds whose graph consists of paths and cycles. Particles without a bond are in no
  /// chain. An open chain starts at its end of smaller index, a ring at its smallest index towards the
  /// smaller of that bead's two partners; chains come in ascending order of their first beads. So neither the
  /// order of the bonds nor that of the two ends of a bond matters. O(particles + bonds).
  /// @throws InvalidParameter for an index outside [0, particles), a bond of a bead with itself, a bond given
  /// twice,
  ///   and a bead with three or more bonds (named: it is a branch, not a necklace).
  static Chains from_bonds(std::size_t particles, Span<const IndexPair> bonds);

  /// One open chain for each molecule number, its beads in order of index; molecule 0 means "none", as in
  /// LAMMPS. Chains come in ascending order of their molecule numbers. O(n lg n).
  /// @throws InvalidParameter for a negative molecule number.
  static Chains from_molecules(Span<const std::int32_t> molecules);

  /// Adds a chain, beads in order along it.
  /// @throws InvalidParameter for no bead, an index outside [0, particles), a bead that repeats or stands in
  ///   another chain already, and a ring of fewer than three beads. After a throw the chains are as they
  ///   were.
  void add(Span<const std::int32_t> beads, bool closed = false);

  /// Chains over `particles` particles, none yet; see add().
  /// @throws InvalidParameter for more particles than kMaxIndexCount.
  explicit Chains(std::size_t particles);

  std::size_t size() const { return closed_.size(); }         ///< number of chains
  std::size_t particles() const { return chain_of_.size(); }  ///< number of particles, in chains or not
  bool closed(std::size_t chain) const { return closed_[chain]; }
  /// Beads of a chain in order along it.
  Span<const std::int32_t> beads(std::size_t chain) const {
    return {beads_.data() + first_[chain], static_cast<std::size_t>(first_[chain + 1] - first_[chain])};
  }
  /// The chain in which a particle stands; -1 for none.
  std::int32_t chain_of(std::int32_t particle) const { return chain_of_[static_cast<std::size_t>(particle)]; }

  /// All bonds, chain by chain in order along each; a ring's closing bond {last, first} comes last.
  std::vector<IndexPair> bonds() const;

 private:
  std::vector<std::int64_t> first_{0};  ///< chain k is beads_[first_[k]] .. beads_[first_[k+1]-1]
  std::vector<std::int32_t> beads_;
  std::vector<bool> closed_;
  std::vector<std::int32_t> chain_of_;
};

/// Makes chains whole across periodic boundaries: the first bead of each chain stays where it is, each
/// further bead becomes the image nearest to its predecessor. Every result is the given position plus an
/// integer combination of the cell vectors, so rounding does not add up along a chain. Particles in no chain
/// stay where they are. O(n).
///
/// Hypothesis: each bond is shorter than half the smallest height of the reduced periodic cell,
/// box.max_cutoff(). Then its nearest image is unique; otherwise the chain's course is a guess.
/// @throws Undetermined if a bond is as long as that limit or longer, and for a ring that winds around the
/// box, which
///   has no closed image.
/// @throws InvalidParameter if the number of positions is not chains.particles().
std::vector<Vec3> unwrap(const Chains& chains, Span<const Vec3> positions, const Box& box);

}  // namespace dch::necklace
#pragma GCC visibility pop
