// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/instruction_set.hpp>

namespace dch::detail {

/// Points of one block; the first dimension of a test is a block.
inline constexpr int kBlock = 8;
/// Candidates of one chunk; the second dimension of a test is made of chunks. A mask holds one bit for each.
inline constexpr int kChunk = 32;
inline constexpr int kBlocksInChunk = kChunk / kBlock;

// Coordinates are 16-bit integers, in units chosen by the caller, and are subtracted modulo 2^16: right where
// the true difference is within 32767 units. Squares are halved twice over in between so that they fit:
//   square(d) = (d * d + 2^14) >> 15,
// and sums saturate at 32767. All sets do this the same, so all find the same.

/// Coordinates of a block's points; lanes without a point hold anything.
struct alignas(16) BlockPoints {
  std::int16_t x[kBlock], y[kBlock], z[kBlock];
};

struct BlockSpan {  ///< A box.
  std::int16_t center[3], half_width[3];
};

/// Boxes side by side. Each array can be read up to kChunk entries beyond its end.
struct BlockSpans {
  const std::int16_t *center[3], *half_width[3];
  const std::int32_t* number;  ///< number[k] is k
};

/// Blocks that lie side by side and have a common shift.
struct BlockRange {
  std::int32_t first, count;
  std::int16_t box_shift[3], point_shift[3];  ///< to add to their boxes and to their points
};

/// Points side by side: coordinates in one array each, and whose they are.
struct Candidates {
  std::int16_t *x, *y, *z;
  std::int32_t* id;
  std::int16_t* tag = nullptr;  ///< what its cutoffs depend on: radius or type; for the kernels that say so
};

/// Types that the kernels can tell apart.
inline constexpr int kKernelTypes = 16;

/// Limits of one type with each of the types.
struct alignas(32) TypeLimits {
  std::int16_t limit[kKernelTypes];
};

/// Entries of a row-by-chunk mask that a test could not settle.
struct Unsettled {
  std::int32_t row, chunk;
  std::uint32_t lanes;
};

/// The loops that lists are made with, compiled for one instruction set. No function allocates.
struct ListKernels {
  /// Finds the blocks of some ranges whose boxes are near a box: sum of square(gap) < limit, with gap =
  /// max(|difference of centers| - both half_widths, 0) along each axis. Writes them range after range, and
  /// where those of each range end. Returns how many; room for kChunk more is needed.
  std::int32_t (*collect)(const BlockSpan& box, std::int16_t limit, const BlockSpans& boxes,
                          const BlockRange* ranges, std::int32_t range_count, std::int32_t* block,
                          std::int32_t* range_end);

  /// Copies the points of the blocks that collect() has found side by side, shifted by their ranges, with all
  /// lanes of each.
  void (*gather)(const std::int32_t* block, const std::int32_t* range_end, const BlockRange* ranges,
                 std::int32_t range_count, const BlockPoints* points,
                 const std::int32_t* ids,   ///< kBlock a block
                 const std::int16_t* tags,  ///< the same, or null where there are none
                 const Candidates& to);

  /// Adds to the coordinates of `count` candidates; up to kBlock entries beyond are overwritten.
  void (*shift)(const Candidates& points, const std::int16_t* by, std::int32_t count);

  /// Copies, in order, those of `count` candidates whose bit is set in `valid` (all, if that is null) and
  /// that are near a box: sum of square(gap) < limit, with gap = max(|coordinate - center| - half_width, 0)
  /// along each axis. Returns how many. `from` is read and `to` overwritten up to kChunk entries beyond.
  std::int32_t (*filter)(const BlockSpan& box, std::int16_t limit, const Candidates& from,
                         const std::uint32_t* valid, std::int32_t count, const Candidates& to);

  /// Tests the points of a block against `count` candidates: with t = sum of square(difference), mask[row *
  /// stride + chunk] gets the lanes with t < in, and those with in <= t < out are told apart in `unsettled`.
  /// Returns how many of the latter there are; room for kBlock times the chunks is needed.
  std::int32_t (*test)(const BlockPoints& points, const Candidates& candidates, std::int32_t count,
                       std::int16_t in, std::int16_t out, std::uint32_t* mask, std::int32_t stride,
                       Unsettled* unsettled);

  /// filter() with the limit square(tag + size) + band, and tags copied too.
  std::int32_t (*filter_by_size)(const BlockSpan& box, std::int16_t size, std::int16_t band,
                                 const Candidates& from, const std::uint32_t* valid, std::int32_t count,
                                 const Candidates& to);
  /// filter() with the limit limits[tag], and tags copied too.
  std::int32_t (*filter_by_type)(const BlockSpan& box, const TypeLimits& limits, const Candidates& from,
                                 const std::uint32_t* valid, std::int32_t count, const Candidates& to);

  /// test() with in = square(tag + size of the row) - band and out = square(tag + size of the row) + band.
  std::int32_t (*test_by_size)(const BlockPoints& points, const std::int16_t* sizes,
                               const Candidates& candidates, std::int32_t count, std::int16_t band,
                               std::uint32_t* mask, std::int32_t stride, Unsettled* unsettled);
  /// test() with in = in[type of the row][tag], out likewise.
  std::int32_t (*test_by_type)(const BlockPoints& points, const std::int16_t* types,
                               const Candidates& candidates, std::int32_t count, const TypeLimits* in,
                               const TypeLimits* out, std::uint32_t* mask, std::int32_t stride,
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

/// The kernels of a set that is supported.
const ListKernels& list_kernels(InstructionSet set);

}  // namespace dch::detail
