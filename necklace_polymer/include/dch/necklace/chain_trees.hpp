// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/necklace/necklace.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// A balanced binary tree along each chain (thesis 4.3), which does not change while the chains move: the
/// beads below a node are a range of places, its canonical subnecklace. A node of m beads has children of
/// ceil(m/2) and floor(m/2), so a tree of n beads has depth ceil(lg n) with single beads as leaves. A ring is
/// cut at its first bead.
///
/// Nodes stand in flat arrays, depth first: the left child follows its parent, and children come after their
/// parents.
class ChainTrees {
 public:
  struct Node {
    std::int32_t first = 0;  ///< first place
    std::int32_t count = 0;  ///< number of beads, >= 1
    std::int32_t right = 0;  ///< the right child; 0 for a leaf
    bool is_leaf() const { return right == 0; }
  };

  ChainTrees() = default;
  /// @param leaf_beads nodes of this many beads and fewer are leaves; 1 gives the tree of the thesis
  /// @throws InvalidParameter unless 1 <= leaf_beads <= 64, and for trees that might have more nodes than
  ///   kMaxIndexCount (from 2^30 beads on where leaf_beads is 1).
  ChainTrees(const Necklace& necklace, int leaf_beads);

  Span<const Node> nodes() const { return nodes_; }
  const Node& node(std::int32_t k) const { return nodes_[static_cast<std::size_t>(k)]; }
  static std::int32_t left(std::int32_t k) { return k + 1; }
  /// One for each chain.
  Span<const std::int32_t> roots() const { return roots_; }
  int leaf_beads() const { return leaf_beads_; }

 private:
  void grow(std::int32_t first, std::int32_t count);

  std::vector<Node> nodes_;
  std::vector<std::int32_t> roots_;
  int leaf_beads_ = 1;
};

}  // namespace dch::necklace
#pragma GCC visibility pop
