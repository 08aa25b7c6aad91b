// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/engines/neighbor_pairs.hpp>
#include <dch/geometry/box.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Arrays of pairs, an element or a row for each pair (NeighborPairs says what i, j, S and D are); those that
/// are null are not filled. Not owned.
struct PairColumns {
  std::int64_t *i = nullptr, *j = nullptr;
  std::array<std::int64_t, 3>* shift = nullptr;  ///< S
  double* distance = nullptr;                    ///< |D| [length]
  Vec3* displacement = nullptr;                  ///< D [length]
  float* single_distance = nullptr;              ///< |D|, rounded
  std::array<float, 3>* single_displacement = nullptr;
};

using MakeColumns = std::function<PairColumns(std::int64_t pairs)>;

/// What neighbor_pairs() finds, as arrays, sorted by i: for callers who want each pair once and keep no rows.
/// Pairs go from where an engine finds them to where they are wanted, without a list in between, where each
/// pair of particles has one image within reach. The order of the neighbors of a particle is the same on any
/// number of threads and any instruction set.
///
/// @param with_itself by particle, whether it is a pair with itself too, with S = 0, before its others; empty
///   if none is
/// @param columns is called once, by the caller's thread, for arrays of so many pairs
/// @return the number of pairs
/// @throws as neighbor_pairs(), and what columns() throws; InvalidParameter for a skin
std::int64_t neighbor_columns(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params,
                              Span<const char> with_itself, const MakeColumns& columns);

/// The pairs of a NeighborPairs at its positions, or at those of the last follow(), in the same way.
/// @param columns is called for arrays of as many pairs as are listed, of which the first are filled
/// @return the number of pairs that are meant
std::int64_t columns_of(const NeighborPairs& pairs, Span<const Vec3> positions, NeighborPairs::Within within,
                        Span<const char> with_itself, Executor* executor, const MakeColumns& columns);

}  // namespace dch
#pragma GCC visibility pop
