// SPDX-License-Identifier: MIT
//
// The list kernels over a vector type `Simd`. Included by one source file for each instruction set, which is
// compiled for that set alone; everything here has internal linkage, so that the linker cannot put code of
// one set in the place of another's. For the same reason nothing of the standard library is used.
#pragma once

#include "simd/list_kernels.hpp"

namespace dch::detail {
namespace {

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
      if (end - k < Simd::kLanes) lanes &= ~(~0u << (end - k));
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
    const std::int16_t* const shift = ranges[r].point_shift;
    for (; n < range_end[r]; ++n) {
      const BlockPoints& from = points[block[n]];
      const std::int64_t first = static_cast<std::int64_t>(block[n]) * kBlock;
      Simd::copy_shifted(from.x, shift[0], to.x + n * kBlock);
      Simd::copy_shifted(from.y, shift[1], to.y + n * kBlock);
      Simd::copy_shifted(from.z, shift[2], to.z + n * kBlock);
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

// --- limits of a row's pairs: `out(k)` and `in(k)` for the candidates from k on

template <class Simd>
struct OneLimit {
  using V = typename Simd::V;
  static constexpr bool kTags = false;
  V limit_in, limit_out;
  void use_row(int) {}
  V in(std::int32_t) const { return limit_in; }
  V out(std::int32_t) const { return limit_out; }
};

template <class Simd>
struct LimitBySize {
  using V = typename Simd::V;
  static constexpr bool kTags = true;
  const std::int16_t* sizes;  ///< of the rows
  const std::int16_t* tags;
  V band;
  V size{};
  void use_row(int row) { size = Simd::set1(sizes[row]); }
  V middle(std::int32_t k) const { return Simd::square(Simd::adds(Simd::load(tags + k), size)); }
  V in(std::int32_t k) const { return Simd::sub(middle(k), band); }
  V out(std::int32_t k) const { return Simd::adds(middle(k), band); }
};

template <class Simd>
struct LimitByType {
  using V = typename Simd::V;
  static constexpr bool kTags = true;
  const std::int16_t* types;  ///< of the rows
  const std::int16_t* tags;
  const TypeLimits *limits_in, *limits_out;
  typename Simd::Table row_in{}, row_out{};
  void use_row(int row) {
    row_in = Simd::table(limits_in[types[row]].limit);
    row_out = Simd::table(limits_out[types[row]].limit);
  }
  V in(std::int32_t k) const { return Simd::look_up(row_in, Simd::load(tags + k)); }
  V out(std::int32_t k) const { return Simd::look_up(row_out, Simd::load(tags + k)); }
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
    if (count - k < Simd::kLanes) lanes &= ~(~0u << (count - k));
    if constexpr (Limit::kTags) Simd::move_to_front(lanes, Simd::load(from.tag + k), to.tag + kept);
    kept += Simd::move_to_front(lanes, px, py, pz, from.id + k, to.x + kept, to.y + kept, to.z + kept,
                                to.id + kept);
  }
  return kept;
}

template <class Simd>
std::int32_t filter(const BlockSpan& box, std::int16_t limit, const Candidates& from,
                    const std::uint32_t* valid, std::int32_t count, const Candidates& to) {
  const OneLimit<Simd> one{Simd::set1(limit), Simd::set1(limit)};
  return filter_with<Simd>(box, one, from, valid, count, to);
}

template <class Simd>
std::int32_t filter_by_size(const BlockSpan& box, std::int16_t size, std::int16_t band,
                            const Candidates& from, const std::uint32_t* valid, std::int32_t count,
                            const Candidates& to) {
  LimitBySize<Simd> limit{&size, from.tag, Simd::set1(band)};
  limit.use_row(0);
  return filter_with<Simd>(box, limit, from, valid, count, to);
}

template <class Simd>
std::int32_t filter_by_type(const BlockSpan& box, const TypeLimits& limits, const Candidates& from,
                            const std::uint32_t* valid, std::int32_t count, const Candidates& to) {
  constexpr std::int16_t kFirst = 0;
  LimitByType<Simd> limit{&kFirst, from.tag, &limits, &limits};
  limit.use_row(0);
  return filter_with<Simd>(box, limit, from, valid, count, to);
}

template <class Simd, class Limit>
std::int32_t test_with(const BlockPoints& points, const Candidates& candidates, std::int32_t count,
                       Limit limit, std::uint32_t* mask, std::int32_t stride, Unsettled* unsettled) {
  using V = typename Simd::V;
  constexpr int kParts = kChunk / Simd::kLanes;
  const std::int32_t chunks = (count + kChunk - 1) / kChunk;
  const std::uint32_t last = ~0u >> ((kChunk - count % kChunk) % kChunk);
  std::int32_t left = 0;
  for (int row = 0; row < kBlock; ++row) {
    const V px = Simd::set1(points.x[row]), py = Simd::set1(points.y[row]), pz = Simd::set1(points.z[row]);
    limit.use_row(row);
    for (std::int32_t chunk = 0; chunk < chunks; ++chunk) {
      std::uint32_t inside = 0, maybe = 0;
      for (int part = 0; part < kParts; ++part) {
        const std::int32_t k = chunk * kChunk + part * Simd::kLanes;
        const V dx = Simd::sub(Simd::load(candidates.x + k), px);
        const V dy = Simd::sub(Simd::load(candidates.y + k), py);
        const V dz = Simd::sub(Simd::load(candidates.z + k), pz);
        const V t = Simd::adds(Simd::adds(Simd::square(dx), Simd::square(dy)), Simd::square(dz));
        inside |= Simd::bits_greater(limit.in(k), t) << (part * Simd::kLanes % kChunk);
        maybe |= Simd::bits_greater(limit.out(k), t) << (part * Simd::kLanes % kChunk);
      }
      const std::uint32_t lanes = chunk + 1 == chunks ? last : ~0u;
      mask[row * stride + chunk] = inside & lanes;
      const std::uint32_t open = maybe & ~inside & lanes;
      if (open != 0) unsettled[left++] = {row, chunk, open};
    }
  }
  return left;
}

template <class Simd>
std::int32_t test(const BlockPoints& points, const Candidates& candidates, std::int32_t count,
                  std::int16_t in, std::int16_t out, std::uint32_t* mask, std::int32_t stride,
                  Unsettled* unsettled) {
  const OneLimit<Simd> limit{Simd::set1(in), Simd::set1(out)};
  return test_with<Simd>(points, candidates, count, limit, mask, stride, unsettled);
}

template <class Simd>
std::int32_t test_by_size(const BlockPoints& points, const std::int16_t* sizes, const Candidates& candidates,
                          std::int32_t count, std::int16_t band, std::uint32_t* mask, std::int32_t stride,
                          Unsettled* unsettled) {
  const LimitBySize<Simd> limit{sizes, candidates.tag, Simd::set1(band)};
  return test_with<Simd>(points, candidates, count, limit, mask, stride, unsettled);
}

template <class Simd>
std::int32_t test_by_type(const BlockPoints& points, const std::int16_t* types, const Candidates& candidates,
                          std::int32_t count, const TypeLimits* in, const TypeLimits* out,
                          std::uint32_t* mask, std::int32_t stride, Unsettled* unsettled) {
  const LimitByType<Simd> limit{types, candidates.tag, in, out};
  return test_with<Simd>(points, candidates, count, limit, mask, stride, unsettled);
}

template <class Simd>
std::int32_t compress(const std::uint32_t* mask, std::int32_t chunks, const std::int32_t* ids,
                      std::int32_t* out) {
  std::int32_t written = 0;
  for (std::int32_t chunk = 0; chunk < chunks; ++chunk)
    written += Simd::compress_chunk(mask[chunk], ids + chunk * kChunk, out + written);
  return written;
}

template <class Simd>
std::int32_t leave_out(std::int32_t* row, std::int32_t count, const std::int32_t* excluded,
                       std::int32_t excluded_count) {
  std::int32_t kept = 0;
  for (std::int32_t k = 0; k < count; k += Simd::kIds) {
    std::uint32_t lanes = (1u << Simd::kIds) - 1;
    if (count - k < Simd::kIds) lanes = (1u << (count - k)) - 1;
    for (std::int32_t e = 0; e < excluded_count; ++e) lanes &= ~Simd::equal_ids(row + k, excluded[e]);
    kept += Simd::compress_ids(lanes, row + k, row + kept);
  }
  return kept;
}

// NOLINTEND(bugprone-easily-swappable-parameters)

template <class Simd>
constexpr ListKernels kernels_of{collect<Simd>,        gather<Simd>,       shift<Simd>,
                                 filter<Simd>,         test<Simd>,         filter_by_size<Simd>,
                                 filter_by_type<Simd>, test_by_size<Simd>, test_by_type<Simd>,
                                 compress<Simd>,       leave_out<Simd>};

}  // namespace
}  // namespace dch::detail
