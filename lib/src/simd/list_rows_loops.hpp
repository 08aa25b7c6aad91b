// SPDX-License-Identifier: MIT
//
// Tests and rows in one loop, over a vector type `Simd`: see list_kernels_loops.hpp for the rules.
#pragma once

#include "simd/list_kernels.hpp"

namespace dch::detail {
namespace {

inline constexpr std::int32_t kAhead = 768;     ///< entries that memory is asked for before they are written
inline constexpr std::int32_t kIdsInLine = 16;  ///< of a cache line

// NOLINTBEGIN(bugprone-easily-swappable-parameters): the signatures are those of ListKernels

// --- limits of a row's pairs: `middle(k)` for the candidates from k on, as RowLimits has it

template <class Simd>
struct OneMiddle {
  using V = typename Simd::V;
  explicit OneMiddle(const RowLimits& limits, const Candidates&) : all(Simd::set1(limits.middle)) {}
  void use_row(int) {}
  V middle(std::int32_t) const { return all; }
  V all;
};

template <class Simd>
struct MiddleBySize {
  using V = typename Simd::V;
  explicit MiddleBySize(const RowLimits& limits, const Candidates& candidates)
      : sizes(limits.rows), tags(candidates.tag), skin(limits.skin), raise(Simd::set1(limits.raise)) {}
  void use_row(int row) { size = Simd::set1(static_cast<std::int16_t>(sizes[row] + skin)); }
  V middle(std::int32_t k) const {
    return Simd::adds(Simd::square(Simd::adds(Simd::load(tags + k), size)), raise);
  }
  const std::int16_t *sizes, *tags;
  std::int16_t skin;
  V raise, size{};
};

template <class Simd>
struct MiddleByType {
  using V = typename Simd::V;
  explicit MiddleByType(const RowLimits& limits, const Candidates& candidates)
      : types(limits.rows), tags(candidates.tag), by_type(limits.by_type) {}
  void use_row(int row) { of_row = Simd::table(by_type[types[row]].limit); }
  V middle(std::int32_t k) const { return Simd::look_up(of_row, Simd::load(tags + k)); }
  const std::int16_t *types, *tags;
  const TypeLimits* by_type;
  typename Simd::Table of_row{};
};

// --- ids that are left out of a row: `lanes(ids)` of a chunk, as RowsTo has them

template <class Simd>
struct NoneExcluded {
  explicit NoneExcluded(const std::int32_t*) {}
  void use_row(int) {}
  std::uint32_t lanes(const std::int32_t*) const { return 0; }
};

template <class Simd>
struct FewExcluded {
  explicit FewExcluded(const std::int32_t* of_rows) : excluded(of_rows) {}
  void use_row(int row) {
    static_assert(kFewExcluded == 2);
    first = Simd::set1_id(excluded[kFewExcluded * row]);
    second = Simd::set1_id(excluded[kFewExcluded * row + 1]);
  }
  std::uint32_t lanes(const std::int32_t* ids) const { return Simd::lanes_of_either(ids, first, second); }
  const std::int32_t* excluded;
  typename Simd::Id first{}, second{};
};

/// A point of a block and the candidates that it is tested against.
template <class Simd, class Middle>
struct RowTest {
  using V = typename Simd::V;
  RowTest(const BlockPoints& points, const Candidates& others, const RowLimits& limits)
      : block(points), candidates(others), limit(limits, others), band(Simd::set1(limits.band)) {}
  void use_row(int row) {
    px = Simd::set1(block.x[row]);
    py = Simd::set1(block.y[row]);
    pz = Simd::set1(block.z[row]);
    limit.use_row(row);
  }
  V sum(std::int32_t k) const {
    const V dx = Simd::sub(Simd::load(candidates.x + k), px);
    const V dy = Simd::sub(Simd::load(candidates.y + k), py);
    const V dz = Simd::sub(Simd::load(candidates.z + k), pz);
    return Simd::adds(Simd::adds(Simd::square(dx), Simd::square(dy)), Simd::square(dz));
  }
  /// What a chunk says of a row: its lanes within the limit, and how far the sums are above the band's begin,
  /// modulo 2^16, the least of those in the same lane of a register.
  struct Chunk {
    std::uint32_t within;
    V least;
  };
  Chunk test(std::int32_t chunk) const {
    Chunk found{0, {}};
    for (int part = 0; part < kChunk / Simd::kLanes; ++part) {
      const std::int32_t k = chunk * kChunk + part * Simd::kLanes;
      const V t = sum(k), middle = limit.middle(k), above = Simd::sub(t, Simd::sub(middle, band));
      found.within |= (Simd::bits_greater(middle, t) & Simd::kAll) << (part * Simd::kLanes);
      found.least = part == 0 ? above : Simd::least(found.least, above);
    }
    return found;
  }
  /// Lanes of a chunk in the band, which is so wide.
  std::uint32_t lanes_in_band(std::int32_t chunk, std::uint16_t width) const {
    std::uint32_t in_band = 0;
    for (int part = 0; part < kChunk / Simd::kLanes; ++part) {
      const std::int32_t k = chunk * kChunk + part * Simd::kLanes;
      const V above = Simd::sub(sum(k), Simd::sub(limit.middle(k), band));
      in_band |= (Simd::bits_below(above, Simd::set1(static_cast<std::int16_t>(width))) & Simd::kAll)
                 << (part * Simd::kLanes);
    }
    return in_band;
  }

  const BlockPoints& block;
  Candidates candidates;  // a copy: what is written might overlap with the other for all that compilers know
  Middle limit;
  V band, px{}, py{}, pz{};
};

/// Which lanes of the chunks hold candidates of a row, and no point of the block at or before it.
struct ValidLanes {
  ValidLanes(std::int32_t count, std::int32_t chunk_count, bool own_first)
      : chunks(chunk_count),
        last(~0u >> ((kChunk - count % kChunk) % kChunk)),
        first(own_first ? ~1u : ~0u),
        step(own_first ? 1 : 0) {}
  std::uint32_t operator()(std::int32_t chunk) const {
    std::uint32_t lanes = ~0u;
    if (chunk == 0) lanes = first;
    if (chunk == chunks - 1) lanes &= last;
    return lanes;
  }
  void next_row() { first <<= step; }
  std::int32_t chunks;
  std::uint32_t last, first;
  int step;
};

/// Rare, so apart from the loop over all chunks, and with copies of what that keeps in registers.
/// `in_segment(chunk)`: its lanes that may belong to the segment.
template <class Simd, class Middle, class InSegment>
[[gnu::noinline]] std::int32_t note_open(RowTest<Simd, Middle> test, ValidLanes valid, std::uint16_t width,
                                         std::int32_t row, InSegment in_segment, std::int32_t segment,
                                         OpenLanes* open) {
  std::int32_t noted = 0, before = 0;
  for (std::int32_t chunk = 0; chunk < valid.chunks; ++chunk) {
    const std::uint32_t lanes = valid(chunk) & in_segment(chunk);
    const std::uint32_t within = test.test(chunk).within & lanes;
    const std::uint32_t in_band = test.lanes_in_band(chunk, width) & lanes;
    if (in_band != 0) open[noted++] = {row, segment, chunk, before, in_band, within};
    before += __builtin_popcount(within);
  }
  return noted;
}

/// @tparam kFixed the number of chunks, or 0 for any
template <class Simd, class Middle, class Excluded, int kFixed>
std::int32_t write_rows(const BlockPoints& points, std::int32_t rows, const Candidates& candidates,
                        std::int32_t count, const RowLimits& limits, const RowsTo& to) {
  const std::int32_t chunks = kFixed > 0 ? kFixed : (count + kChunk - 1) / kChunk;
  RowTest<Simd, Middle> test(points, candidates, limits);
  ValidLanes valid(count, chunks, to.own_first);
  Excluded excluded(to.excluded);
  const auto width = static_cast<std::uint16_t>(2 * limits.band);
  const std::int32_t* const id = candidates.id;
  std::int32_t* const j = to.j;
  std::int32_t* const end = to.end;
  OpenLanes* const open = to.open;
  std::int32_t written = 0, noted = 0;
  for (std::int32_t row = 0; row < rows; ++row) {
    test.use_row(row);
    excluded.use_row(row);
    __builtin_prefetch(j + written + kAhead, 1);
    __builtin_prefetch(j + written + kAhead + kIdsInLine, 1);
    const std::int32_t begin = written;
    for (std::int32_t chunk = 0; chunk < chunks; ++chunk) {
      const auto found = test.test(chunk);
      const std::uint32_t wanted = valid(chunk) & ~excluded.lanes(id + chunk * kChunk);
      const std::uint32_t lanes = found.within & wanted;
      if (__builtin_expect(Simd::any_below(found.least, width), 0)) {
        const std::uint32_t in_band = test.lanes_in_band(chunk, width) & wanted;
        if (in_band != 0) open[noted++] = {row, row, chunk, written - begin, in_band, lanes};
      }
      written += Simd::compress_chunk(lanes, id + chunk * kChunk, j + written);
    }
    end[row] = written;
    valid.next_row();
  }
  return noted;
}

/// The same with those nearer than another limit first in each row.
template <class Simd, class Middle, class Excluded>
std::int32_t write_rows_with_shell(const BlockPoints& points, std::int32_t rows, const Candidates& candidates,
                                   std::int32_t count, const RowLimits& limits, const RowLimits& near,
                                   const RowsTo& to) {
  using V = typename Simd::V;
  const std::int32_t chunks = (count + kChunk - 1) / kChunk;
  RowTest<Simd, Middle> test(points, candidates, limits), near_test(points, candidates, near);
  ValidLanes valid(count, chunks, to.own_first);
  Excluded excluded(to.excluded);
  const auto width = static_cast<std::uint16_t>(2 * limits.band);
  const std::int32_t* const id = candidates.id;
  std::int32_t written = 0, noted = 0;
  for (std::int32_t row = 0; row < rows; ++row) {
    test.use_row(row);
    near_test.use_row(row);
    excluded.use_row(row);
    for (int part = 0; part < 2; ++part) {
      V least = Simd::set1(-1);
      const auto in_segment = [&](std::int32_t chunk) {
        const std::uint32_t lanes = near_test.test(chunk).within;
        return (part == 0 ? lanes : ~lanes) & ~excluded.lanes(id + chunk * kChunk);
      };
      for (std::int32_t chunk = 0; chunk < chunks; ++chunk) {
        const auto found = test.test(chunk);
        least = Simd::least(least, found.least);
        const std::uint32_t lanes = found.within & valid(chunk) & in_segment(chunk);
        written += Simd::compress_chunk(lanes, id + chunk * kChunk, to.j + written);
      }
      const std::int32_t segment = 2 * row + part;
      to.end[segment] = written;
      if (Simd::any_below(least, width))
        noted += note_open(test, valid, width, row, in_segment, segment, to.open + noted);
    }
    valid.next_row();
  }
  return noted;
}

template <class Simd, class Middle, class Excluded>
std::int32_t rows_without(const BlockPoints& points, std::int32_t rows, const Candidates& candidates,
                          std::int32_t count, const RowLimits& limits, const RowLimits* near,
                          const RowsTo& to) {
  if (near != nullptr)
    return write_rows_with_shell<Simd, Middle, Excluded>(points, rows, candidates, count, limits, *near, to);
  switch ((count + kChunk - 1) / kChunk) {
    case 1:
      return write_rows<Simd, Middle, Excluded, 1>(points, rows, candidates, count, limits, to);
    case 2:
      return write_rows<Simd, Middle, Excluded, 2>(points, rows, candidates, count, limits, to);
    case 3:
      return write_rows<Simd, Middle, Excluded, 3>(points, rows, candidates, count, limits, to);
    case 4:
      return write_rows<Simd, Middle, Excluded, 4>(points, rows, candidates, count, limits, to);
    case 5:
      return write_rows<Simd, Middle, Excluded, 5>(points, rows, candidates, count, limits, to);
    case 6:
      return write_rows<Simd, Middle, Excluded, 6>(points, rows, candidates, count, limits, to);
    default:
      return write_rows<Simd, Middle, Excluded, 0>(points, rows, candidates, count, limits, to);
  }
}

template <class Simd, class Middle>
std::int32_t rows_with(const BlockPoints& points, std::int32_t rows, const Candidates& candidates,
                       std::int32_t count, const RowLimits& limits, const RowLimits* near, const RowsTo& to) {
  if (to.excluded != nullptr)
    return rows_without<Simd, Middle, FewExcluded<Simd>>(points, rows, candidates, count, limits, near, to);
  return rows_without<Simd, Middle, NoneExcluded<Simd>>(points, rows, candidates, count, limits, near, to);
}

// NOLINTEND(bugprone-easily-swappable-parameters)

}  // namespace
}  // namespace dch::detail
