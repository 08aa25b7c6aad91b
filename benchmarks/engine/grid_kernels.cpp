// SPDX-License-Identifier: MIT
#include "grid_kernels.hpp"

#include <algorithm>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
// The loops below once more for processors with wider vectors; which one runs is decided when the program
// starts.
#define DCH_FOR_WIDE_VECTORS __attribute__((target_clones("default", "avx2", "arch=skylake-avx512")))
#define DCH_AVX512 __attribute__((target("avx512f,avx512bw,avx512vl,avx512dq")))
#else
#define DCH_FOR_WIDE_VECTORS
#endif

namespace dch::bench {

namespace {

constexpr std::int32_t kGroup = kChunk / 2;
// Vectors of the compiler, since it cannot know that what is read and what is written do not overlap.
using Shorts [[gnu::vector_size(2 * kGroup)]] = std::uint16_t;
using Words [[gnu::vector_size(4 * kGroup)]] = std::uint32_t;
using Numbers [[gnu::vector_size(4 * kGroup)]] = std::int32_t;
using Floats [[gnu::vector_size(4 * kGroup)]] = float;

template <class Vector, class T>
[[gnu::always_inline]] inline void load(const T* from, Vector& to) {
  std::memcpy(&to, from, sizeof to);
}
template <class Vector, class T>
[[gnu::always_inline]] inline void store(const Vector& from, T* to) {
  std::memcpy(to, &from, sizeof from);
}

}  // namespace

DCH_FOR_WIDE_VECTORS
void copy_shifted(const detail::Candidates& from, const std::array<std::int16_t, 3>& shift,
                  std::int32_t count, const detail::Candidates& to) {
  const std::int16_t* const sources[3] = {from.x, from.y, from.z};
  std::int16_t* const targets[3] = {to.x, to.y, to.z};
  for (std::int32_t k = 0; k < count; k += kGroup) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Shorts v;
      load(sources[axis] + k, v);
      store(v + static_cast<std::uint16_t>(shift[axis]), targets[axis] + k);
    }
    Words ids;
    load(from.id + k, ids);
    store(ids, to.id + k);
  }
}

DCH_FOR_WIDE_VECTORS
void copy_shortened(const FinePoints& from, int shift, std::int32_t count, const detail::Candidates& to) {
  const std::uint32_t* const sources[3] = {from.x, from.y, from.z};
  std::int16_t* const targets[3] = {to.x, to.y, to.z};
  for (std::int32_t k = 0; k < count; k += kGroup) {
    Words v;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      load(sources[axis] + k, v);
      store(__builtin_convertvector(v >> shift, Shorts), targets[axis] + k);
    }
    load(from.word + k, v);
    store(v, to.id + k);
  }
}

DCH_FOR_WIDE_VECTORS
void unpack(const std::int32_t* words, float per_code, std::int32_t count, std::int32_t* numbers,
            std::int16_t* radii) {
  for (std::int32_t k = 0; k < count; k += kGroup) {
    Numbers v;
    load(words + k, v);
    store(v & (kMaxParticles - 1), numbers + k);
    const Floats units = __builtin_convertvector(v >> kNumberBits, Floats) * per_code + 0.5f;
    store(__builtin_convertvector(__builtin_convertvector(units, Numbers), Shorts), radii + k);
  }
}

namespace {

struct Lanes {
  std::uint32_t in, open;
};

/// One row against one chunk.
struct Row {
  std::int16_t x, y, z, reach, band;
};

[[maybe_unused]] Lanes test_plain(const Row& row, const detail::Candidates& c, const std::int16_t* radii,
                                  std::int32_t first) {
  const auto square = [](std::int16_t d) { return (std::int32_t{d} * d + 0x4000) >> 15; };
  const auto minus = [](std::int16_t a, std::int16_t b) {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(a) - static_cast<std::uint16_t>(b));
  };
  Lanes lanes{0, 0};
  for (std::int32_t lane = 0; lane < kChunk; ++lane) {
    const std::int32_t k = first + lane;
    const std::int32_t t =
        square(minus(c.x[k], row.x)) + square(minus(c.y[k], row.y)) + square(minus(c.z[k], row.z));
    const std::int32_t limit = square(static_cast<std::int16_t>(std::min(32767, row.reach + radii[k])));
    lanes.in |= std::uint32_t{t < limit - row.band} << lane;
    lanes.open |= std::uint32_t{t >= limit - row.band && t < limit + row.band} << lane;
  }
  return lanes;
}

#if defined(__x86_64__)
/// Squares of the differences of 32 coordinates from one. Half a period, -2^15, is the one difference whose
/// square overflows, to a negative number: it is taken for one less.
DCH_AVX512 inline __m512i squares(const std::int16_t* from, std::int16_t at) {
  const __m512i d = _mm512_max_epi16(_mm512_sub_epi16(_mm512_loadu_si512(from), _mm512_set1_epi16(at)),
                                     _mm512_set1_epi16(-32767));
  return _mm512_mulhrs_epi16(d, d);
}

DCH_AVX512 inline Lanes test_avx512(const Row& row, const detail::Candidates& c, const std::int16_t* radii,
                                    std::int32_t first) {
  const __m512i t =
      _mm512_adds_epi16(_mm512_adds_epi16(squares(c.x + first, row.x), squares(c.y + first, row.y)),
                        squares(c.z + first, row.z));
  const __m512i s = _mm512_adds_epi16(_mm512_loadu_si512(radii + first), _mm512_set1_epi16(row.reach));
  const __m512i limit = _mm512_mulhrs_epi16(s, s), band = _mm512_set1_epi16(row.band);
  const std::uint32_t in = _mm512_cmpgt_epi16_mask(_mm512_sub_epi16(limit, band), t);
  return {in, _mm512_cmpgt_epi16_mask(_mm512_adds_epi16(limit, band), t) & ~in};
}
#endif

template <class Test>
[[gnu::always_inline]] inline std::int32_t test_rows(const Test& test, const detail::BlockPoints& points,
                                                     const std::int16_t* reach, std::int32_t count,
                                                     std::int16_t band, std::uint32_t* mask,
                                                     std::int32_t stride, Unsettled* unsettled) {
  std::int32_t open = 0;
  for (std::int32_t r = 0; r < kBlock; ++r) {
    const Row row{points.x[r], points.y[r], points.z[r], reach[r], band};
    for (std::int32_t first = 0, chunk = 0; first < count; first += kChunk, ++chunk) {
      const std::int32_t left = count - first;
      const std::uint32_t valid = left >= kChunk ? ~0u : (1u << left) - 1;
      const Lanes lanes = test(row, first);
      mask[r * stride + chunk] = lanes.in & valid;
      unsettled[open] = {r, chunk, lanes.open & valid};
      open += (lanes.open & valid) != 0;
    }
  }
  return open;
}

#if defined(__x86_64__)
DCH_AVX512 std::int32_t test_rows_avx512(const detail::BlockPoints& points, const std::int16_t* reach,
                                         const detail::Candidates& candidates, const std::int16_t* radii,
                                         std::int32_t count, std::int16_t band, std::uint32_t* mask,
                                         std::int32_t stride, Unsettled* unsettled) {
  return test_rows([&](const Row& row, std::int32_t first)
                       DCH_AVX512 { return test_avx512(row, candidates, radii, first); },
                   points, reach, count, band, mask, stride, unsettled);
}
#endif

}  // namespace

std::int32_t test_radii(const detail::BlockPoints& points, const std::int16_t* reach,
                        const detail::Candidates& candidates, const std::int16_t* radii, std::int32_t count,
                        std::int16_t band, std::uint32_t* mask, std::int32_t stride, Unsettled* unsettled) {
#if defined(__x86_64__)
  if (instruction_set() == InstructionSet::avx512)
    return test_rows_avx512(points, reach, candidates, radii, count, band, mask, stride, unsettled);
#endif
  return test_rows(
      [&](const Row& row, std::int32_t first) { return test_plain(row, candidates, radii, first); }, points,
      reach, count, band, mask, stride, unsettled);
}

}  // namespace dch::bench
