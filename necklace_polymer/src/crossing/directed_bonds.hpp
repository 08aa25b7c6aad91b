// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/necklace/chains.hpp>

namespace dch::necklace::detail {

/// Bonds in the order that CrossingFinder::bonds() says.
struct DirectedBonds {
  std::vector<IndexPair> bonds;
  std::size_t on_chains = 0;  ///< the first so many have a direction
};

DirectedBonds directed_bonds(const Chains& chains);
/// @throws InvalidParameter as CrossingFinder's constructor.
DirectedBonds directed_bonds(std::size_t particles, Span<const IndexPair> bonds);

/// Which bonds of `now` are not among those of `before`, whatever the order of their beads.
std::vector<bool> new_bonds(const std::vector<IndexPair>& before, const std::vector<IndexPair>& now);

}  // namespace dch::necklace::detail
