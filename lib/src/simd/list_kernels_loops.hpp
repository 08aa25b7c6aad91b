// SPDX-License-Identifier: MIT
//
// The list kernels over a vector type `Simd`. Included by one source file for each instruction set, which is
// compiled for that set alone; everything here has internal linkage, so that the linker cannot put code of
// one set in the place of another's. For the same reason nothing of the standard library is used.
#pragma once

#include "simd/list_kernels.hpp"
#include "simd/list_rows_loops.hpp"

namespace dch::detail {
namespace {

/// So many bits, up to 32.
inline std::uint32_t first_lanes(std::int32_t count) {
  return static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
}

// NOLINTBEGIN(bugprone-easily-swappable-parameters): the signatures are those of ListKernels

template <class Simd>
std::int32_t collect(const BlockSpan& box, std::int16_t limit, const BlockSpans& boxes,
                     const BlockRange* ranges, std::int32_t range_count, std::int32_t* block,
                     std::int32_t* range_end) {
  using V = typename Simd::V;
  const V most = Simd::set1(limit);
  const V wx = Simd::set1(box.half_width[0]), wy = Simd::set1(box.half_width[1]),
          wz = Simd::set1(box.half_width[2]);
  std::int32_t found = 0;
  for (std::int32_t r = 0; r < range_count; ++r) {
    const V shift_x = Simd::set1(ranges[r].box_shift[0]), shift_y = Simd::set1(ranges[r].box_shift[1]),
            shift_z = Simd::set1(ranges[r].box_shift[2]);
    const V cx = Simd::sub(Simd::set1(box.center[0]), shift_x),
            cy = Simd::sub(Simd::set1(box.center[1]), shift_y),
            cz = Simd::sub(Simd::set1(box.center[2]), shift_z);
    const std::int32_t end = ranges[r].first + ranges[r].count;
    for (std::int32_t k = ranges[r].first; k < end; k += Simd::kLanes) {
      const auto gap = [&](int axis, V center, V width) {
        return Simd::above(Simd::abs(Simd::sub(Simd::load(boxes.center[axis] + k), center)),
                           Simd::adds(Simd::load(boxes.half_width[axis] + k), width));
      };
      const V gx = gap(0, cx, wx), gy = gap(1, cy, wy), gz = gap(2, cz, wz);
      const V t = Simd::adds(Simd::adds(Simd::square(gx), Simd::square(gy)), Simd::square(gz));
      std::uint32_t lanes = Simd::bits_greater(most, t) & Simd::kAll;
      if (end - k < Simd::kLanes) lanes &= first_lanes(end - k);
      found += Simd::compress_lanes(lanes, Simd::kLanes, boxes.number + k, block + found);
    }
    range_end[r] = found;
  }
  return found;
}

template <class Simd>
void gather(const std::int32_t* block, const std::int32_t* range_end, const BlockRange* ranges,
            std::int32_t range_count, const BlockPoints* points, const std::int32_t* ids,
            const std::int16_t* tags, const Candidates& to) {
  std::int32_t n = 0;
  for (std::int32_t r = 0; r < range_count; ++r) {
    const std::int16_t(*const shift)[2] = ranges[r].point_shift;
    for (; n < range_end[r]; ++n) {
      const BlockPoints& from = points[block[n]];
      const std::int64_t first = static_cast<std::int64_t>(block[n]) * kBlock;
      Simd::copy_saturated(from.x, shift[0], to.x + n * kBlock);
      Simd::copy_saturated(from.y, shift[1], to.y + n * kBlock);
      Simd::copy_saturated(from.z, shift[2], to.z + n * kBlock);
      Simd::copy_ids(ids + first, to.id + n * kBlock);
      if (tags) Simd::copy_shifted(tags + first, 0, to.tag + n * kBlock);
    }
  }
}

template <class Simd>
void shift(const Candidates& points, const std::int16_t* by, std::int32_t count) {
  for (std::int32_t k = 0; k < count; k += kBlock) {
    Simd::copy_shifted(points.x + k, by[0], points.x + k);
    Simd::copy_shifted(points.y + k, by[1], points.y + k);
    Simd::copy_shifted(points.z + k, by[2], points.z + k);
  }
}

// --- limits of a filter: `out(k)` for the candidates from k on

template <class Simd>
struct OneLimit {
  using V = typename Simd::V;
  static constexpr bool kTags = false;
  V limit;
  V out(std::int32_t) const { return limit; }
};

template <class Simd>
struct LimitBySize {
  using V = typename Simd::V;
  static constexpr bool kTags = true;
  const std::int16_t* tags;
  V size, band;
  V out(std::int32_t k) const {
    return Simd::adds(Simd::square(Simd::adds(Simd::load(tags + k), size)), band);
  }
};

template <class Simd>
struct LimitByType {
  using V = typename Simd::V;
  static constexpr bool kTags = true;
  const std::int16_t* tags;
  typename Simd::Table limits;
  V out(std::int32_t k) const { return Simd::look_up(limits, Simd::load(tags + k)); }
};

template <class Simd, class Limit>
std::int32_t filter_with(const BlockSpan& box, const Limit& limit, const Candidates& from,
                         const std::uint32_t* valid, std::int32_t count, const Candidates& to) {
  using V = typename Simd::V;
  const V cx = Simd::set1(box.center[0]), cy = Simd::set1(box.center[1]), cz = Simd::set1(box.center[2]);
  const V hx = Simd::set1(box.half_width[0]), hy = Simd::set1(box.half_width[1]),
          hz = Simd::set1(box.half_width[2]);
  std::int32_t kept = 0;
  for (std::int32_t k = 0; k < count; k += Simd::kLanes) {
    const V px = Simd::load(from.x + k), py = Simd::load(from.y + k), pz = Simd::load(from.z + k);
    const V gx = Simd::above(Simd::abs(Simd::sub(px, cx)), hx);
    const V gy = Simd::above(Simd::abs(Simd::sub(py, cy)), hy);
    const V gz = Simd::above(Simd::abs(Simd::sub(pz, cz)), hz);
    const V t = Simd::adds(Simd::adds(Simd::square(gx), Simd::square(gy)), Simd::square(gz));
    std::uint32_t lanes = Simd::bits_greater(limit.out(k), t) & Simd::kAll;
    if (valid) lanes &= valid[k / kChunk] >> (k % kChunk);
    if (count - k < Simd::kLanes) lanes &= first_lanes(count - k);
    if constexpr (Limit::kTags) Simd::move_to_front(lanes, Simd::load(from.tag + k), to.tag + kept);
    kept += Simd::move_to_front(lanes, px, py, pz, from.id + k, to.x + kept, to.y + kept, to.z + kept,
                                to.id + kept);
  }
  return kept;
}

template <class Simd>
std::int32_t filter(const BlockSpan& box, std::int16_t limit, const Candidates& from,
                    const std::uint32_t* valid, std::int32_t count, const Candidates& to) {
  return filter_with<Simd>(box, OneLimit<Simd>{Simd::set1(limit)}, from, valid, count, to);
}

template <class Simd>
std::int32_t filter_by_size(const BlockSpan& box, std::int16_t size, std::int16_t band,
                            const Candidates& from, const std::uint32_t* valid, std::int32_t count,
                            const Candidates& to) {
  const LimitBySize<Simd> limit{from.tag, Simd::set1(size), Simd::set1(band)};
  return filter_with<Simd>(box, limit, from, valid, count, to);
}

template <class Simd>
std::int32_t filter_by_type(const BlockSpan& box, const TypeLimits& limits, const Candidates& from,
                            const std::uint32_t* valid, std::int32_t count, const Candidates& to) {
  const LimitByType<Simd> limit{from.tag, Simd::table(limits.limit)};
  return filter_with<Simd>(box, limit, from, valid, count, to);
}

template <class Simd>
std::int32_t leave_out(const std::int32_t* row, std::int32_t count, const std::int32_t* excluded,
                       std::int32_t excluded_count, std::int32_t* to) {
  std::int32_t kept = 0;
  for (std::int32_t k = 0; k < count; k += Simd::kIds) {
    std::uint32_t lanes = first_lanes(count - k < Simd::kIds ? count - k : Simd::kIds);
    for (std::int32_t e = 0; e < excluded_count; ++e) lanes &= ~Simd::equal_ids(row + k, excluded[e]);
    kept += Simd::compress_ids(lanes, row + k, to + kept);
  }
  return kept;
}

// NOLINTEND(bugprone-easily-swappable-parameters)

template <class Simd>
constexpr ListKernels kernels_of{collect<Simd>,
                                 gather<Simd>,
                                 shift<Simd>,
                                 filter<Simd>,
                                 filter_by_size<Simd>,
                                 filter_by_type<Simd>,
                                 rows_with<Simd, OneMiddle<Simd>>,
                                 rows_with<Simd, MiddleBySize<Simd>>,
                                 rows_with<Simd, MiddleByType<Simd>>,
                                 leave_out<Simd>};

}  // namespace
}  // namespace dch::detail
