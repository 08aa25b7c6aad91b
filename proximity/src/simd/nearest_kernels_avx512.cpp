// SPDX-License-Identifier: MIT
#include <immintrin.h>

#include "simd/nearest_kernels_loops.hpp"

namespace dch::detail {
namespace {

struct NearestAvx512 {
  static constexpr std::int32_t kLanes = 16;
  using Floats __attribute__((vector_size(64))) = float;
  using Ints __attribute__((vector_size(64))) = std::int32_t;

  static std::uint32_t at_most(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  static std::uint32_t equal(Ints a, Ints b) {
    return _mm512_cmpeq_epi32_mask(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b));
  }
  // Compressed in a register, then stored whole: a compressing store is many times slower on some processors.
  static std::int32_t append(std::uint32_t lanes, Floats a, Ints b, float* to_a, std::int32_t* to_b) {
    const auto mask = static_cast<__mmask16>(lanes);
    _mm512_storeu_ps(to_a, _mm512_maskz_compress_ps(mask, a));
    _mm512_storeu_si512(to_b, _mm512_maskz_compress_epi32(mask, reinterpret_cast<__m512i>(b)));
    return __builtin_popcount(lanes);
  }
};

}  // namespace

const NearestKernels kNearestAvx512 = NearestLoops<NearestAvx512>::kKernels;

}  // namespace dch::detail
