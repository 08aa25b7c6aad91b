// SPDX-License-Identifier: MIT
#include <immintrin.h>

#include "simd/nearest_kernels_loops.hpp"
#include "simd/pack_table.hpp"

namespace dch::detail {
namespace {

struct NearestAvx2 {
  static constexpr std::int32_t kLanes = 8;
  using Floats __attribute__((vector_size(32))) = float;
  using Ints __attribute__((vector_size(32))) = std::int32_t;

  static std::uint32_t at_most(Floats a, Floats b) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)));
  }
  static std::uint32_t equal(Ints a, Ints b) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(a == b)));
  }
  static std::int32_t append(std::uint32_t lanes, Floats a, Ints b, float* to_a, std::int32_t* to_b) {
    const __m256i order =
        _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(kPack.lanes[lanes])));
    _mm256_storeu_ps(to_a, _mm256_permutevar8x32_ps(a, order));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to_b),
                        _mm256_permutevar8x32_epi32(reinterpret_cast<__m256i>(b), order));
    return __builtin_popcount(lanes);
  }
};

}  // namespace

const NearestKernels kNearestAvx2 = NearestLoops<NearestAvx2>::kKernels;

}  // namespace dch::detail
