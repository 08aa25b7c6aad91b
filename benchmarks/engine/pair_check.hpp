// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/engines/pair_search.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "scene.hpp"

namespace dch::bench {

/// What a set of pairs adds up to, whatever their order and in whichever row each stands.
struct PairSum {
  std::int64_t pairs = 0;
  std::uint64_t hash = 0;

  void add(std::int32_t i, std::int32_t j);
  friend bool operator==(const PairSum& a, const PairSum& b) {
    return a.pairs == b.pairs && a.hash == b.hash;
  }
};

PairSum sum_of(const NeighborList& list);

/// The same of those pairs alone that list number `which` of the scene has to hold, exclusions aside: for
/// lists that may hold others.
PairSum sum_within(const NeighborList& list, const Scene& scene, std::size_t which);

/// What list number `which` of the scene has to hold. For one radius it is that of dch::make_cell_search(),
/// or of dch::all_pairs() for few particles; for particles with radii it is found here, from all pairs but
/// those of small spheres in cells of their own that are too far apart.
PairSum expected_pairs(const Scene& scene, std::size_t which);

}  // namespace dch::bench
