// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// The oracle: every pair within its cutoff by looking at all n(n-1)/2 of them and at every lattice image
/// that could be near enough. O(n^2) time. It shares no code with the engines: images are enumerated from the
/// perpendicular heights of the cell as given, without any reduction.
/// @throws as PairSearch::update and PairSearch::list.
NeighborList all_pairs(Span<const Vec3> positions, const Box& box, const ListParams& params);

/// One row of that oracle: the neighbors of particle i, as in a full list, so none for a ghost. O(n).
/// @throws InvalidParameter if there is no particle i; as PairSearch::list.
std::vector<std::int32_t> all_neighbors(std::int32_t i, Span<const Vec3> positions, const Box& box,
                                        const ListParams& params);

}  // namespace dch
#pragma GCC visibility pop
