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
// and sums saturate at 32767. All sets do this the same but for the square of -32768, so all find the same.

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
  std::int16_t box_shift[3];       ///< to add to their boxes
  std::int16_t point_shift[3][2];  ///< to add to their points, saturating: two numbers of one sign
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

/// What the rows of a block are limited by. A candidate is in a row if t < middle, with t = sum of
/// square(difference) and middle, by kernel:
///   rows            middle
///   rows_by_size    square(tag + skin + size of the row) + raise
///   rows_by_type    by_type[type of the row][tag]
/// Rounding leaves open whether it belongs there if middle - band <= t < middle + band.
struct RowLimits {
  std::int16_t middle = 0;
  std::int16_t band = 0;
  std::int16_t skin = 0, raise = 0;
  const TypeLimits* by_type = nullptr;
  const std::int16_t* rows = nullptr;  ///< sizes or types of the rows
};

/// Lanes of a chunk that are open in a row. A row is one segment, or two where it has a shell: near ones
/// first.
struct OpenLanes {
  std::int32_t row, segment, chunk;
  std::int32_t before;          ///< entries of the segment in the chunks before
  std::uint32_t lanes, within;  ///< within: lanes whose ids are in the segment
};

/// Ids that a row can be written without; more of them are left out of it later.
inline constexpr int kFewExcluded = 2;

/// Where rows are written.
struct RowsTo {
  std::int32_t* j;    ///< segment after segment; up to kChunk entries beyond are overwritten
  std::int32_t* end;  ///< by segment
  OpenLanes* open;    ///< room for two a row and chunk
  bool own_first;     ///< the first candidates are the block's points: a row takes those after its own
  const std::int32_t* excluded = nullptr;  ///< kFewExcluded a row, negative where there are fewer; or null
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
  /// lanes of each. Coordinates beyond 16 bits saturate.
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

  /// filter() with the limit square(tag + size) + band, and tags copied too.
  std::int32_t (*filter_by_size)(const BlockSpan& box, std::int16_t size, std::int16_t band,
                                 const Candidates& from, const std::uint32_t* valid, std::int32_t count,
                                 const Candidates& to);
  /// filter() with the limit limits[tag], and tags copied too.
  std::int32_t (*filter_by_type)(const BlockSpan& box, const TypeLimits& limits, const Candidates& from,
                                 const std::uint32_t* valid, std::int32_t count, const Candidates& to);

  /// Tests the first `count` points of a block, its rows, against candidates, and writes the ids of those
  /// within the limits, in order. Rows have a shell if `near` is not null: those within it, which leaves
  /// nothing open, come first. Returns how many OpenLanes were noted, in the order of segments and chunks.
  using Rows = std::int32_t(const BlockPoints& points, std::int32_t count, const Candidates& candidates,
                            std::int32_t candidate_count, const RowLimits& limits, const RowLimits* near,
                            const RowsTo& to);
  Rows* rows;
  Rows* rows_by_size;
  Rows* rows_by_type;

  /// Copies those of a row's ids that are not among `excluded`, in order. Returns how many. The row is read,
  /// and its copy overwritten, up to 16 entries beyond its end; it may be copied to its own place.
  std::int32_t (*leave_out)(const std::int32_t* row, std::int32_t count, const std::int32_t* excluded,
                            std::int32_t excluded_count, std::int32_t* to);
};

/// The kernels of a set that is supported.
const ListKernels& list_kernels(InstructionSet set);

}  // namespace dch::detail
