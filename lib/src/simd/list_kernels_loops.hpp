// SPDX-License-Identifier: MIT
//
// The list kernels over a vector type `Simd`. Included by one source file for each instruction set, which is
// compiled for that set alone; everything here has internal linkage, so that the linker cannot put code of
// one set in the place of another's. For the same reason nothing of the standard library is used.
#pragma once

#include "list_kernels.hpp"

namespace dch::detail {
namespace {

// NOLINTBEGIN(bugprone-easily-swappable-parameters): the signatures are those of ListKernels

template <class Simd>
std::int32_t collect(const BlockBox& box, std::int16_t limit, const BlockBox* boxes, const BlockRange* ranges,
                     std::int32_t range_count, std::int32_t* block, std::int32_t* range, BoxColumns columns) {
  // lo_j - hi and lo - hi_j in one subtraction
  const BlockBox opposite{{static_cast<std::int16_t>(-box.v[4]), static_cast<std::int16_t>(-box.v[5]),
                           static_cast<std::int16_t>(-box.v[6]), 0, static_cast<std::int16_t>(-box.v[0]),
                           static_cast<std::int16_t>(-box.v[1]), static_cast<std::int16_t>(-box.v[2]), 0}};
  const auto other = Simd::load_box(opposite);
  std::int32_t found = 0;
  for (std::int32_t r = 0; r < range_count; ++r) {
    const auto shift = Simd::load_box(ranges[r].box_shift);
    for (std::int32_t b = ranges[r].first; b < ranges[r].first + ranges[r].count; ++b) {
      const auto shifted = Simd::shift_box(Simd::load_box(boxes[b]), shift);
      block[found] = b;
      range[found] = r;
      BlockBox corners;
      Simd::store_box(corners, shifted);
      for (int k = 0; k < 3; ++k) {
        columns.corner[k][found] = corners.v[k];
        columns.corner[k + 3][found] = corners.v[k + 4];
      }
      found += Simd::box_gap2(shifted, other) <= limit;
    }
  }
  return found;
}

template <class Simd>
std::int32_t select(const BlockBox& box, std::int16_t limit, BoxColumns columns, std::int32_t first,
                    std::int32_t count, std::int32_t* index) {
  using V = typename Simd::V;
  const V lo[3] = {Simd::set1(box.v[0]), Simd::set1(box.v[1]), Simd::set1(box.v[2])};
  const V minus_hi[3] = {Simd::set1(box.v[4]), Simd::set1(box.v[5]), Simd::set1(box.v[6])};
  const V zero = Simd::set1(0), most = Simd::set1(limit);
  std::int32_t found = 0;
  for (std::int32_t k = first / Simd::kLanes * Simd::kLanes; k < count; k += Simd::kLanes) {
    V sum = zero;
    for (int axis = 0; axis < 3; ++axis) {
      const V above = Simd::adds(Simd::load(columns.corner[axis] + k), minus_hi[axis]);
      const V below = Simd::adds(Simd::load(columns.corner[axis + 3] + k), lo[axis]);
      const V gap = Simd::max(Simd::max(above, below), zero);
      sum = Simd::adds(sum, Simd::square(gap));
    }
    std::uint32_t near = ~Simd::bits_greater(sum, most) & Simd::kAll;
    if (k < first) near &= Simd::kAll << (first - k);
    if (count - k < Simd::kLanes) near &= ~(Simd::kAll << (count - k));
    for (; near != 0; near &= near - 1) index[found++] = k + __builtin_ctz(near);
  }
  return found;
}

template <class Simd>
std::int32_t test(const BlockPoints& points, const std::int16_t* x, const std::int16_t* y,
                  const std::int16_t* z, const std::uint32_t* valid, std::int32_t chunks, std::int16_t in,
                  std::int16_t out, std::uint32_t* mask, std::int32_t stride, Unsettled* unsettled) {
  using V = typename Simd::V;
  constexpr int kParts = kChunk / Simd::kLanes;
  const V limit_in = Simd::set1(in), limit_out = Simd::set1(out);
  std::int32_t left = 0;
  for (int row = 0; row < kBlock; ++row) {
    const V px = Simd::set1(points.x[row]), py = Simd::set1(points.y[row]), pz = Simd::set1(points.z[row]);
    for (std::int32_t chunk = 0; chunk < chunks; ++chunk) {
      std::uint32_t inside = 0, maybe = 0;
      for (int part = 0; part < kParts; ++part) {
        const std::int32_t k = chunk * kChunk + part * Simd::kLanes;
        const V dx = Simd::sub(Simd::load(x + k), px);
        const V dy = Simd::sub(Simd::load(y + k), py);
        const V dz = Simd::sub(Simd::load(z + k), pz);
        const V t = Simd::adds(Simd::adds(Simd::square(dx), Simd::square(dy)), Simd::square(dz));
        inside |= Simd::bits_greater(limit_in, t) << (part * Simd::kLanes % kChunk);
        maybe |= Simd::bits_greater(limit_out, t) << (part * Simd::kLanes % kChunk);
      }
      mask[row * stride + chunk] = inside & valid[chunk];
      const std::uint32_t open = maybe & ~inside & valid[chunk];
      if (open != 0) unsettled[left++] = {row, chunk, open};
    }
  }
  return left;
}

template <class Simd>
std::int32_t compress(const std::uint32_t* mask, std::int32_t chunks, const std::int32_t* ids,
                      std::int32_t* out) {
  std::int32_t written = 0;
  for (std::int32_t chunk = 0; chunk < chunks; ++chunk)
    written += Simd::compress_chunk(mask[chunk], ids + chunk * kChunk, out + written);
  return written;
}

// NOLINTEND(bugprone-easily-swappable-parameters)

template <class Simd>
constexpr ListKernels kernels_of{collect<Simd>, select<Simd>, test<Simd>, compress<Simd>};

}  // namespace
}  // namespace dch::detail
