// SPDX-License-Identifier: MIT
//
// The kernels that the grids of this folder are made with, as they were in the library of November 2026 when
// these grids became the measure of what came later: tests first, rows after. They are left as they are.
#pragma once

#include <cstdint>

#include <dch/base/instruction_set.hpp>

#include "simd/list_kernels.hpp"

namespace dch::bench {

using detail::BlockPoints;
using detail::BlockSpan;
using detail::Candidates;
using detail::kBlock;
using detail::kChunk;

/// Entries of a row-by-chunk mask that a test could not settle.
struct Unsettled {
  std::int32_t row, chunk;
  std::uint32_t lanes;
};

struct FrozenKernels {
  /// Copies, in order, those of `count` candidates that are near a box: sum of square(gap) < limit, with gap
  /// = max(|coordinate - center| - half_width, 0) along each axis. Returns how many. `from` is read and `to`
  /// overwritten up to kChunk entries beyond.
  std::int32_t (*filter)(const BlockSpan& box, std::int16_t limit, const Candidates& from, std::int32_t count,
                         const Candidates& to);

  /// Tests the points of a block against `count` candidates: with t = sum of square(difference), mask[row *
  /// stride + chunk] gets the lanes with t < in, and those with in <= t < out are told apart in `unsettled`.
  /// Returns how many of the latter there are; room for kBlock times the chunks is needed.
  std::int32_t (*test)(const BlockPoints& points, const Candidates& candidates, std::int32_t count,
                       std::int16_t in, std::int16_t out, std::uint32_t* mask, std::int32_t stride,
                       Unsettled* unsettled);

  /// Copies the ids whose bit is set, in order. Returns how many; up to 16 entries beyond them are
  /// overwritten.
  std::int32_t (*compress)(const std::uint32_t* mask, std::int32_t chunks, const std::int32_t* ids,
                           std::int32_t* out);

  /// Takes those of a row's ids out that are among `excluded`; the others keep their order. Returns how many
  /// are left. The row is read and overwritten up to 16 entries beyond its end.
  std::int32_t (*leave_out)(std::int32_t* row, std::int32_t count, const std::int32_t* excluded,
                            std::int32_t excluded_count);
};

const FrozenKernels& frozen_kernels(InstructionSet set);

const FrozenKernels& frozen_kernels_portable();
#ifdef DCH_X86_KERNELS
const FrozenKernels& frozen_kernels_avx2();
const FrozenKernels& frozen_kernels_avx512();
#endif

}  // namespace dch::bench
