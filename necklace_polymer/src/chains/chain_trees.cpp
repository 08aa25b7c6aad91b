// SPDX-License-Identifier: MIT
#include <string>

#include <dch/base/index_count.hpp>
#include <dch/necklace/chain_trees.hpp>

namespace dch::necklace {

ChainTrees::ChainTrees(const Necklace& necklace, int leaf_beads) : leaf_beads_(leaf_beads) {
  if (leaf_beads < 1 || leaf_beads > 64) {
    throw InvalidParameter("leaf_beads is " + std::to_string(leaf_beads) + "; it has to be in 1 .. 64");
  }
  const auto beads = static_cast<std::int64_t>(necklace.size());
  // A leaf has one bead or more than half of leaf_beads; a tree has one node less than twice its leaves.
  const std::int64_t leaves =
      leaf_beads == 1 ? beads : 2 * beads / leaf_beads + static_cast<std::int64_t>(necklace.chains().size());
  index_count(2 * leaves, "nodes of the trees along the chains", "take more leaf_beads or fewer beads");
  for (std::size_t chain = 0; chain < necklace.chains().size(); ++chain) {
    roots_.push_back(static_cast<std::int32_t>(nodes_.size()));
    const std::int32_t first = necklace.first_place(chain);
    grow(first, necklace.first_place(chain + 1) - first);
  }
}

void ChainTrees::grow(std::int32_t first, std::int32_t count) {
  const std::size_t here = nodes_.size();
  nodes_.push_back({first, count, 0});
  if (count <= leaf_beads_) return;
  const std::int32_t half = count - count / 2;
  grow(first, half);
  nodes_[here].right = static_cast<std::int32_t>(nodes_.size());
  grow(first + half, count - half);
}

}  // namespace dch::necklace
