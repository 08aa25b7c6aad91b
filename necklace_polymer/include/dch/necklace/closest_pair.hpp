// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <dch/necklace/contacts.hpp>
#include <dch/necklace/necklace.hpp>
#include <dch/necklace/proximity_diagram.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// What a search for the closest pair looked at.
struct ClosestPairStats {
  std::int64_t edges = 0;   ///< edges of the diagram
  std::int64_t common = 0;  ///< pairs with a common neighbor along the chain
  std::int64_t listed = 0;  ///< pairs from the DCH, for unequal radii
};

/// The closest pair of beads that are not neighbors along a chain, from a diagram of the beads
/// (thesis 4.5.2).
///
/// Neighbors are beads of one chain with at most `skip_bonds` bonds between them. Theorem 4.5.2 looks at
/// (1) edges of the power diagram, (2) pairs with a common neighbor and (3) pairs with an improper ball as a
/// neighbor, and asks for balls that are disjoint but for neighbors, and for neighbors that
/// touch.
///
/// For equal radii (1) and (2) are enough and none of the hypotheses is needed. For let i and j be the
/// closest pair: a third center k in the closed ball with diameter ij is nearer to i and to j than they are
/// to each other, so it is a neighbor of both, or stands on the place of one of them. Else ij is an edge.
///
/// For unequal radii (1) and (2) give a bound, and all pairs with gaps up to it come from a DCH, which has
/// case (3) among them and needs no hypothesis either.
///
/// Open space only. Not thread-safe; distinct objects are independent.
class ClosestPair {
 public:
  /// @throws InvalidParameter without a diagram.
  ClosestPair(Necklace necklace, std::unique_ptr<ProximityDiagram> diagram);

  /// Takes new positions, after any displacement.
  /// @throws InvalidParameter for another number of positions than particles and for a periodic box;
  ///   InvalidPosition. Nothing is held after a throw until the next successful update.
  void update(Span<const Vec3> positions, const Box& box);

  /// The pair with the smallest gap between its surfaces, of equal ones that with the smallest (i, j); none
  /// if all pairs are neighbors. O(edges + n skip_bonds), and for unequal radii the pairs that the DCH lists.
  /// @throws InvalidParameter for skip_bonds < 0, and without positions.
  std::optional<Contact> find(int skip_bonds = 1, ClosestPairStats* stats = nullptr) const;

  const Necklace& necklace() const { return necklace_; }
  const ProximityDiagram& diagram() const { return *diagram_; }

 private:
  class Best;
  using Places = std::vector<std::vector<std::int32_t>>;
  Places shared_places() const;
  static void look_at_place(Best& best, const std::vector<std::int32_t>& place);
  void look_at_edges(Best& best, ClosestPairStats& stats) const;
  void look_along_chains(Best& best, int skip_bonds, ClosestPairStats& stats) const;
  void look_at_listed(Best& best, ClosestPairStats& stats) const;

  Necklace necklace_;
  std::unique_ptr<ProximityDiagram> diagram_;
  std::vector<Ball> beads_;  ///< by place
  bool equal_ = true;        ///< whether all radii are the same
  bool ready_ = false;
};

}  // namespace dch::necklace
#pragma GCC visibility pop
