// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/necklace/bond_encounter.hpp>
#include <dch/necklace/chains.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

struct CrossingFinderParams {
  /// Bonds whose axes come within it are contacts, >= 0; with 0 only bonds that touch [length].
  double thickness = 0;
  /// Threads to search on; null for that of the caller alone. Not owned; results do not depend on it.
  Executor* executor = nullptr;
};

/// Two bonds went through each other during a step.
struct BondCrossing : Crossing {
  std::int32_t p = 0, q = 0;  ///< bonds, p < q; a sign of 0 where one of them is on no chain
};

/// Two bonds came within the thickness of each other, or touched without going through.
struct BondContact {
  std::int32_t p = 0, q = 0;  ///< bonds, p < q
  double time = 0;            ///< when they first did, 0 .. 1
  double distance = 0;        ///< of their axes then [length]
};

/// A bond of which a step says nothing.
struct UndeterminedBond {
  enum class Reason {
    bead_moved_too_far,  ///< half the smallest height of the box or more: its image is a guess
    bond_too_long        ///< as long as that, or longer
  };
  std::int32_t bond = 0;
  Reason reason = Reason::bead_moved_too_far;
};

/// How the pairs of bonds of a step were decided. Pairs go through the tests in the order of the members,
/// each of which counts those that it was the first to reject.
struct CrossingStats {
  std::int64_t bonds = 0;
  std::int64_t near_pairs = 0;  ///< pairs that the search for near midpoints gave, without bonded neighbors
  std::int64_t by_ball = 0;     ///< rejected by balls around both sweeps
  std::int64_t by_box = 0;      ///< by axis-parallel boxes
  std::int64_t by_zonotope = 0;
  std::int64_t by_cubic = 0;  ///< no crossing, by signs of doubles
  std::int64_t exact = 0;     ///< decided by integers
  std::int64_t wide = 0;      ///< bonds that move so far that each was compared with all others

  CrossingStats& operator+=(const CrossingStats& other);
};

/// What happened during a step.
struct StepCrossings {
  std::vector<BondCrossing> crossings;         ///< by p, q and time
  std::vector<BondContact> contacts;           ///< by p and q
  std::vector<UndeterminedBond> undetermined;  ///< by bond; all pairs with these are left out
  std::int64_t started = 0;  ///< bonds that were not there at the beginning of the step, left out as well
  CrossingStats stats;
};

/// Finds the bonds that go through each other from one set of positions to the next.
///
///     dch::necklace::CrossingFinder finder(chains);
///     finder.start(positions, box);
///     while (read_frame(positions, box)) report(finder.step(positions, box).crossings);
///
/// Beads go along straight lines to the images nearest to where they were; in a box that changes its shape,
/// to where the change alone would have taken them. bond_encounter() says which crossings there are, exactly
/// for the positions and cell vectors as given. Hypotheses, checked bond by bond: each bead moves less than
/// half the smallest height of the box, and bonds are shorter than that. A bond that fails is reported as
/// undetermined and never as free of crossings.
///
/// Bonds that share a bead are not compared. Signs go by the direction of bonds along their chains.
///
/// The search: near pairs of the bonds' midpoints halfway through the step, by a reach that is the same for
/// all; those few bonds that move much farther than most are compared with all others. Then a ball, a box,
/// and the zonotope of the same-time difference reject pairs, each in a way that loses no crossing.
///
/// O(n) at bounded density of bonds and steps of bounded length. Events come in the order that StepCrossings
/// says, and nothing depends on threads. Not thread-safe; distinct objects are independent.
class CrossingFinder {
 public:
  /// @throws InvalidParameter for a thickness that is negative or not finite.
  explicit CrossingFinder(const Chains& chains, const CrossingFinderParams& params = {});
  /// Of any bonds. Those of a graph's parts in which no bead has more than two make chains, as
  /// Chains::from_bonds() does; in parts with branches crossings have no sign.
  /// @throws InvalidParameter for an index outside [0, particles), a bond of a bead with itself, a bond given
  ///   twice, and as above.
  CrossingFinder(std::size_t particles, Span<const IndexPair> bonds, const CrossingFinderParams& params = {});
  ~CrossingFinder();
  CrossingFinder(CrossingFinder&&) noexcept;
  CrossingFinder& operator=(CrossingFinder&&) noexcept;

  /// All bonds, those of chains first, chain by chain and directed along it, then those of parts with
  /// branches.
  Span<const IndexPair> bonds() const;

  /// Bonds were made or broken: those that were not there start with the next positions, so the step to these
  /// says nothing about them. Bonds are numbered anew.
  /// @throws InvalidParameter as the constructor; then the bonds are as they were.
  void set_bonds(Span<const IndexPair> bonds);
  void set_bonds(const Chains& chains);

  /// Takes positions to begin with, or after a gap.
  /// @throws InvalidPosition; InvalidParameter if their number is not that of the particles.
  void start(Span<const Vec3> positions, const Box& box);

  /// What happened since the last positions; these are the last ones from then on. The reference holds until
  /// the next call. After a throw nothing is held until the next start().
  /// @throws InvalidPosition; InvalidParameter if their number is not that of the particles, without a
  /// start(),
  ///   and for a box that is periodic along other vectors than before.
  const StepCrossings& step(Span<const Vec3> positions, const Box& box);

  /// Of what is kept from step to step, and of the search. O(1).
  std::size_t memory_bytes() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch::necklace
#pragma GCC visibility pop
