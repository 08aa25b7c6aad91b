// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <dch/necklace/cage_hierarchy.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// How an update finds beads that have left a cage.
enum class Verification {
  /// From the children of a cage downwards, as far as their cages stick out of it (thesis 4.4.2).
  cascade,
  /// All beads of the cage: O(n lg n) tests. For comparison.
  naive,
  /// Of a large cage only the beads that were farthest out when all of them were last looked at, as long as
  /// what beads and cage have moved since cannot have brought another one out; of a small cage all beads.
  watched
};

struct WrappedParams {
  /// Nodes of this many beads and fewer are leaves, whose beads are looked at one by one, 1 .. 64. 1 gives
  /// the hierarchy of the thesis; with more there are fewer cages to keep and to compare.
  int leaf_beads = 8;
  Verification verification = Verification::watched;
};

/// What updates did; sums since the hierarchy was made, without the first build.
struct WrappedStats {
  std::int64_t updates = 0;
  std::int64_t cages_checked = 0;      ///< cages of two beads and more
  std::int64_t containment_tests = 0;  ///< is a cage, or a bead, inside a cage? Beads of its basis are
  std::int64_t escapes = 0;            ///< beads that had left a cage and entered its basis
  std::int64_t basis_changes = 0;      ///< cages whose basis is another one, or a part of what it was
  std::int64_t looks = 0;              ///< watched cages of which all beads had to be looked at
};

/// The wrapped hierarchy (thesis 4.4): the cage of a node is the minimum enclosing ball of its beads. It is
/// stored as the two to four beads it rests on, its basis, which lasts while the chain deforms.
///
/// Children's cages may stick out of their parent's: only beads are enclosed. Hypotheses: none
/// on the necklace; bounds on the cost of queries need those of Theorem 4.5.1 (contacts.hpp). Not
/// thread-safe; distinct objects are independent.
class WrappedHierarchy : public CageHierarchy {
 public:
  /// @throws InvalidParameter unless 1 <= leaf_beads <= 64.
  explicit WrappedHierarchy(Necklace necklace, const WrappedParams& params = {});

  /// Finds all bases anew, from those of the children up: O(n lg n), less in practice.
  /// @throws InvalidParameter for another number of positions than particles, InvalidPosition, Undetermined
  ///   (see unwrap()). The hierarchy is empty after a throw.
  void build(Span<const Vec3> positions, const Box& box);

  /// Takes new positions, after any displacement. Each cage becomes the ball of the basis it had, which is
  /// right if no bead of it is outside (Lemma 4.4.4); else the bead farthest outside enters the basis, until
  /// none is. The first update, and one after a throw, builds.
  /// @throws as build()
  void update(Span<const Vec3> positions, const Box& box);

  /// By node: the places of the beads that its cage rests on, as members of the basis.
  Span<const Basis> bases() const { return bases_; }
  const WrappedParams& params() const { return params_; }
  const WrappedStats& stats() const { return stats_; }
  std::size_t memory_bytes() const;

 private:
  /// What is remembered of a large cage since all its beads were last looked at.
  struct Watch {
    std::array<std::int32_t, 16> places{};  ///< of the beads farthest out then
    Vec3 center;                            ///< of the cage then
    /// No other bead reached farther from there; infinite before the first look.
    double rest = std::numeric_limits<double>::infinity();
    double travelled = 0;  ///< no bead of the cage has moved farther since then
  };

  void find_bases(Span<const Vec3> positions, const Box& box);
  void repair_bases(Span<const Vec3> positions, const Box& box);
  void forget();
  EnclosingBall of_leaf(const ChainTrees::Node& node) const;
  EnclosingBall of_children(std::int32_t k) const;
  void repair(std::int32_t k, EnclosingBall found, Verification verification);
  std::int32_t farthest(std::int32_t k, const EnclosingBall& found, Verification verification, double& reach);
  std::int32_t farthest_by_cascade(std::int32_t k, const EnclosingBall& found, double& reach);
  std::int32_t farthest_of_range(const ChainTrees::Node& node, const EnclosingBall& found, double& reach);
  std::int32_t farthest_of_watched(const ChainTrees::Node& node, Watch& watch, const EnclosingBall& found,
                                   double& reach);
  void scan(const ChainTrees::Node& node, Vec3 center, Watch& watch);
  void note_motion();

  WrappedParams params_;
  bool even_ = true;  ///< all beads have the same radius
  std::vector<Basis> bases_;
  std::vector<std::int32_t> watch_of_;  ///< by node: which of watches_, -1 for none
  std::vector<Watch> watches_;
  std::vector<double> bead_moved2_, moved2_;  ///< by place, by node: squared, at most, in the last update
  WrappedStats stats_;
};

}  // namespace dch::necklace
#pragma GCC visibility pop
