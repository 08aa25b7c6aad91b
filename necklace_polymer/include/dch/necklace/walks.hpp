// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/necklace/shapes.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// A random walk with bonds of length 1; beads may overlap at will. The same bits on every platform.
/// @throws InvalidParameter for a negative number of beads.
Shape random_walk(std::int32_t beads, std::uint64_t seed);

/// A self-avoiding walk, the model of a swollen chain: bonds of length 1, and no two beads that are not
/// bonded closer than `diameter`. Made by joining walks of half the length in random directions until they do
/// not meet (dimerization; Suzuki, Bull. Chem. Soc. Jpn. 41:538, 1968; Alexandrowicz, J. Chem. Phys. 51:561,
/// 1969). Only the direction of a joint is drawn again, a half only after 100 failures, so walks are not
/// exactly uniform. About O(n lg n).
/// @throws InvalidParameter for a negative number of beads, and unless 0 <= diameter <= 1.
Shape self_avoiding_walk(std::int32_t beads, double diameter, std::uint64_t seed);

/// A collapsed globule: the chain fills a cube along a Hilbert curve of spacing 1, each bead moved at random
/// by up to `jitter` along each axis. Beads up to |bond| = 1 + 2 sqrt(3) jitter apart are bonded.
/// @throws InvalidParameter unless 0 <= beads <= 2^30 and 0 <= jitter <= 1/2.
Shape globule(std::int32_t beads, double jitter, std::uint64_t seed);

}  // namespace dch::necklace
#pragma GCC visibility pop
