// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include <dch/base/span.hpp>

#include "frozen/frozen_kernels.hpp"

namespace dch::bench {

/// A particle's number and its radius, relative to the largest one, in one word, so that the kernels that
/// move candidates about need not know of radii.
inline constexpr int kNumberBits = 20;
inline constexpr std::int32_t kMaxParticles = 1 << kNumberBits;
inline constexpr int kMaxCode = (1 << (31 - kNumberBits)) - 1;

// The next three read and overwrite up to kChunk / 2 entries beyond `count`, which spares loops for what is
// left.

/// Copies candidates, shifted.
void copy_shifted(const detail::Candidates& from, const std::array<std::int16_t, 3>& shift,
                  std::int32_t count, const detail::Candidates& to);

/// Points with coordinates in 32 bits, of which the box is a whole period.
struct FinePoints {
  const std::uint32_t *x, *y, *z;
  const std::int32_t* word;
};

/// Candidates with the coordinates (x >> shift) modulo 2^16.
void copy_shortened(const FinePoints& from, int shift, std::int32_t count, const detail::Candidates& to);

/// Takes words apart: numbers, and radii in units, rounded; a code counts `per_code` units.
void unpack(const std::int32_t* words, float per_code, std::int32_t count, std::int32_t* numbers,
            std::int16_t* radii);

/// As ListKernels::test, with another limit for each pair: with s = reach[row] + radius of the candidate and
/// t = sum of square(difference), lanes with t < square(s) - band are in, those with t < square(s) + band
/// open.
std::int32_t test_radii(const detail::BlockPoints& points, const std::int16_t* reach,
                        const detail::Candidates& candidates, const std::int16_t* radii, std::int32_t count,
                        std::int16_t band, std::uint32_t* mask, std::int32_t stride, Unsettled* unsettled);

}  // namespace dch::bench
