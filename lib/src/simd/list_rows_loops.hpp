// SPDX-License-Identifier: MIT
//
// Tests and rows in one loop, over a vector type `Simd`: see list_kernels_loops.hpp for the rules.
#pragma once

#include "simd/list_kernels.hpp"

namespace dch::detail {
namespace {

constexpr std::int32_t kAhead = 768;     ///< entries that memory is asked for before they are written
constexpr std::int32_t kIdsInLine = 16;  ///< of a cache line

// NOLINTBEGIN(bugprone-easily-swappable-parameters): the signatures are those of ListKernels

// --- the same numbers for one pair

inline int saturated(int v) { return v < 32767 ? v : 32767; }
inline int square(int d) { return (d * d + 0x4000) >> 15; }

/// Of row and candidate k.
inline int sum_of_pair(const BlockPoints& points, int row, const Candidates& candidates, std::int32_t k) {
  const auto difference = [](int a, int b) { return static_cast<std::int16_t>(a - b); };
  return saturated(square(difference(candidates.x[k], points.x[row])) +
                   square(difference(candidates.y[k], points.y[row])) +
                   square(difference(candidates.z[k], points.z[row])));
}

// --- limits of a row's pairs: `middle(k)` for the candidates from k on, as RowLimits has it, and of one pair

template <class Simd>
struct OneMiddle {
  using V = typename Simd::V;
  explicit OneMiddle(const RowLimits& limits, const Candidates&) : all(Simd::set1(limits.middle)) {}
  void use_row(int) {}
  V middle(std::int32_t) const { return all; }
  static int of_pair(const RowLimits& limits, const Candidates&, int, std::int32_t) { return limits.middle; }
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
  static int of_pair(const RowLimits& limits, const Candidates& candidates, int row, std::int32_t k) {
    return saturated(square(saturated(candidates.tag[k] + limits.rows[row] + limits.skin)) + limits.raise);
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
  static int of_pair(const RowLimits& limits, const Candidates& candidates, int row, std::int32_t k) {
    return limits.by_type[limits.rows[row]].limit[candidates.tag[k]];
  }
  const std::int16_t *types, *tags;
  const TypeLimits* by_type;
  typename Simd::Table of_row{};
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
  /// Lanes of a chunk within the limit; `least` gets how far their sums are above the band's begin, modulo
  /// 2^16.
  std::uint32_t lanes_within(std::int32_t chunk, V& least) const {
    std::uint32_t within = 0;
    for (int part = 0; part < kChunk / Simd::kLanes; ++part) {
      const std::int32_t k = chunk * kChunk + part * Simd::kLanes;
      const V t = sum(k), middle = limit.middle(k);
      within |= (Simd::bits_greater(middle, t) & Simd::kAll) << (part * Simd::kLanes);
      least = Simd::least(least, Simd::sub(t, Simd::sub(middle, band)));
    }
    return within;
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

/// What a row is made of.
template <class Middle>
struct RowPairs {
  const BlockPoints& points;
  const Candidates& candidates;
  std::int32_t count;
  const RowLimits& limits;
  int above_band(int row, std::int32_t k) const {
    return sum_of_pair(points, row, candidates, k) - Middle::of_pair(limits, candidates, row, k) +
           limits.band;
  }
  bool is_within(int row, std::int32_t k) const { return above_band(row, k) < limits.band; }
};

template <class Simd>
std::uint32_t lanes_below(typename Simd::V least, std::uint16_t width) {
  return Simd::bits_below(least, Simd::set1(static_cast<std::int16_t>(width))) & Simd::kAll;
}

/// Notes the candidates from `first` on that are open in a row, of which some lanes have one at least. Rare,
/// so apart from the loop over all chunks, and one by one: a row has one of them as a rule.
/// @param lanes bit k % kLanes of the candidates k to be looked at
/// @param in_segment `(k)`: whether candidate k belongs to the segment
template <class Simd, class Middle, class InSegment>
[[gnu::noinline]] std::int32_t note_open(const RowPairs<Middle>& pairs, int row, std::int32_t first,
                                         std::uint32_t lanes, int segment, const InSegment& in_segment,
                                         OpenCandidate* open) {
  const int band = pairs.limits.band;
  std::int32_t noted = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    for (std::int32_t k = __builtin_ctz(lanes); k < pairs.count; k += Simd::kLanes) {
      const int above = pairs.above_band(row, k);
      const int is_open = (above >= 0) & (above < 2 * band) & (k >= first) & static_cast<int>(in_segment(k));
      open[noted] = {k, static_cast<std::uint8_t>(row), static_cast<std::uint8_t>(segment), above < band};
      noted += is_open;
    }
  }
  return noted;
}

/// @tparam kFixed the number of chunks, or 0 for any
template <class Simd, class Middle, int kFixed>
std::int32_t write_rows(const BlockPoints& points, std::int32_t rows, const Candidates& candidates,
                        std::int32_t count, const RowLimits& limits, const RowsTo& to) {
  using V = typename Simd::V;
  const std::int32_t chunks = kFixed > 0 ? kFixed : (count + kChunk - 1) / kChunk;
  RowTest<Simd, Middle> test(points, candidates, limits);
  ValidLanes valid(count, chunks, to.own_first);
  const auto width = static_cast<std::uint16_t>(2 * limits.band);
  const std::int32_t* const id = candidates.id;
  std::int32_t* const j = to.j;
  std::int32_t* const end = to.end;
  OpenCandidate* const open = to.open;
  std::int32_t written = 0, noted = 0;
  for (std::int32_t row = 0; row < rows; ++row) {
    test.use_row(row);
    __builtin_prefetch(j + written + kAhead, 1);
    __builtin_prefetch(j + written + kAhead + kIdsInLine, 1);
    V least = Simd::set1(-1);
    for (std::int32_t chunk = 0; chunk < chunks; ++chunk) {
      const std::uint32_t lanes = test.lanes_within(chunk, least) & valid(chunk);
      written += Simd::compress_chunk(lanes, id + chunk * kChunk, j + written);
    }
    end[row] = written;
    if (Simd::any_below(least, width))
      noted += note_open<Simd>(
          RowPairs<Middle>{points, candidates, count, limits}, row, to.own_first ? row + 1 : 0,
          lanes_below<Simd>(least, width), row, [](std::int32_t) { return true; }, open + noted);
    valid.next_row();
  }
  return noted;
}

/// The same with those nearer than another limit first in each row.
template <class Simd, class Middle>
std::int32_t write_rows_with_shell(const BlockPoints& points, std::int32_t rows, const Candidates& candidates,
                                   std::int32_t count, const RowLimits& limits, const RowLimits& near,
                                   const RowsTo& to) {
  using V = typename Simd::V;
  const std::int32_t chunks = (count + kChunk - 1) / kChunk;
  RowTest<Simd, Middle> test(points, candidates, limits), near_test(points, candidates, near);
  ValidLanes valid(count, chunks, to.own_first);
  const auto width = static_cast<std::uint16_t>(2 * limits.band);
  std::int32_t written = 0, noted = 0;
  for (std::int32_t row = 0; row < rows; ++row) {
    test.use_row(row);
    near_test.use_row(row);
    for (int part = 0; part < 2; ++part) {
      V least = Simd::set1(-1), unused = least;
      const auto in_segment = [&](std::int32_t chunk) {
        const std::uint32_t lanes = near_test.lanes_within(chunk, unused);
        return part == 0 ? lanes : ~lanes;
      };
      for (std::int32_t chunk = 0; chunk < chunks; ++chunk) {
        const std::uint32_t lanes = test.lanes_within(chunk, least) & valid(chunk) & in_segment(chunk);
        written += Simd::compress_chunk(lanes, candidates.id + chunk * kChunk, to.j + written);
      }
      const std::int32_t segment = 2 * row + part;
      to.end[segment] = written;
      const RowPairs<Middle> pairs{points, candidates, count, limits},
          near_pairs{points, candidates, count, near};
      if (Simd::any_below(least, width))
        noted += note_open<Simd>(
            pairs, row, to.own_first ? row + 1 : 0, lanes_below<Simd>(least, width), segment,
            [&](std::int32_t k) { return near_pairs.is_within(row, k) == (part == 0); }, to.open + noted);
    }
    valid.next_row();
  }
  return noted;
}

template <class Simd, class Middle>
std::int32_t rows_with(const BlockPoints& points, std::int32_t rows, const Candidates& candidates,
                       std::int32_t count, const RowLimits& limits, const RowLimits* near, const RowsTo& to) {
  if (near != nullptr)
    return write_rows_with_shell<Simd, Middle>(points, rows, candidates, count, limits, *near, to);
  switch ((count + kChunk - 1) / kChunk) {
    case 1:
      return write_rows<Simd, Middle, 1>(points, rows, candidates, count, limits, to);
    case 2:
      return write_rows<Simd, Middle, 2>(points, rows, candidates, count, limits, to);
    case 3:
      return write_rows<Simd, Middle, 3>(points, rows, candidates, count, limits, to);
    case 4:
      return write_rows<Simd, Middle, 4>(points, rows, candidates, count, limits, to);
    case 5:
      return write_rows<Simd, Middle, 5>(points, rows, candidates, count, limits, to);
    case 6:
      return write_rows<Simd, Middle, 6>(points, rows, candidates, count, limits, to);
    default:
      return write_rows<Simd, Middle, 0>(points, rows, candidates, count, limits, to);
  }
}

// NOLINTEND(bugprone-easily-swappable-parameters)

}  // namespace
}  // namespace dch::detail
