// SPDX-License-Identifier: MIT
//
// The frozen kernels over a vector type `Simd`: see lib/src/simd/list_kernels_loops.hpp for the rules.
#pragma once

#include "frozen/frozen_kernels.hpp"

namespace dch::bench {
namespace {

// NOLINTBEGIN(bugprone-easily-swappable-parameters): the signatures are those of FrozenKernels

template <class Simd>
std::int32_t filter(const BlockSpan& box, std::int16_t limit, const Candidates& from, std::int32_t count,
                    const Candidates& to) {
  using V = typename Simd::V;
  const V most = Simd::set1(limit);
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
    std::uint32_t lanes = Simd::bits_greater(most, t) & Simd::kAll;
    if (count - k < Simd::kLanes) lanes &= ~(~0u << (count - k));
    kept += Simd::move_to_front(lanes, px, py, pz, from.id + k, to.x + kept, to.y + kept, to.z + kept,
                                to.id + kept);
  }
  return kept;
}

template <class Simd>
std::int32_t test(const BlockPoints& points, const Candidates& candidates, std::int32_t count,
                  std::int16_t in, std::int16_t out, std::uint32_t* mask, std::int32_t stride,
                  Unsettled* unsettled) {
  using V = typename Simd::V;
  constexpr int kRegisters = kChunk / Simd::kLanes;
  const V limit_in = Simd::set1(in), limit_out = Simd::set1(out);
  const std::int32_t chunks = (count + kChunk - 1) / kChunk;
  const std::uint32_t last = ~0u >> ((kChunk - count % kChunk) % kChunk);
  std::int32_t left = 0;
  for (int row = 0; row < kBlock; ++row) {
    const V px = Simd::set1(points.x[row]), py = Simd::set1(points.y[row]), pz = Simd::set1(points.z[row]);
    for (std::int32_t chunk = 0; chunk < chunks; ++chunk) {
      std::uint32_t inside = 0, maybe = 0;
      for (int part = 0; part < kRegisters; ++part) {
        const std::int32_t k = chunk * kChunk + part * Simd::kLanes;
        const V dx = Simd::sub(Simd::load(candidates.x + k), px);
        const V dy = Simd::sub(Simd::load(candidates.y + k), py);
        const V dz = Simd::sub(Simd::load(candidates.z + k), pz);
        const V t = Simd::adds(Simd::adds(Simd::square(dx), Simd::square(dy)), Simd::square(dz));
        inside |= Simd::bits_greater(limit_in, t) << (part * Simd::kLanes % kChunk);
        maybe |= Simd::bits_greater(limit_out, t) << (part * Simd::kLanes % kChunk);
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
constexpr FrozenKernels kernels_of{filter<Simd>, test<Simd>, compress<Simd>, leave_out<Simd>};

}  // namespace
}  // namespace dch::bench
