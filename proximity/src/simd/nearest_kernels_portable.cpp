// SPDX-License-Identifier: MIT
#include "simd/nearest_kernels_loops.hpp"

namespace dch::detail {
namespace {

/// Vectors that every processor that has any has.
struct NearestPortable {
  static constexpr std::int32_t kLanes = 4;
  using Floats __attribute__((vector_size(16))) = float;
  using Ints __attribute__((vector_size(16))) = std::int32_t;

  static std::uint32_t bits_of(Ints lanes) {
    const Ints bit = lanes & Ints{1, 2, 4, 8};
    return static_cast<std::uint32_t>(bit[0] | bit[1] | bit[2] | bit[3]);
  }
  static std::uint32_t at_most(Floats a, Floats b) { return bits_of(a <= b); }
  static std::uint32_t equal(Ints a, Ints b) { return bits_of(a == b); }
  static std::int32_t append(std::uint32_t lanes, Floats a, Ints b, float* to_a, std::int32_t* to_b) {
    std::int32_t count = 0;
    if (lanes == 0) return count;
    for (std::int32_t lane = 0; lane < kLanes; ++lane) {
      to_a[count] = a[lane];
      to_b[count] = b[lane];
      count += static_cast<std::int32_t>(lanes >> lane & 1);
    }
    return count;
  }
};

}  // namespace

const NearestKernels kNearestPortable = NearestLoops<NearestPortable>::kKernels;

const NearestKernels& nearest_kernels(InstructionSet set) {
#ifdef DCH_X86_KERNELS
  if (set == InstructionSet::avx512) return kNearestAvx512;
  if (set == InstructionSet::avx2) return kNearestAvx2;
#endif
  static_cast<void>(set);  // the baselines of compilers are next to SSE4.2 and NEON here
  return kNearestPortable;
}

}  // namespace dch::detail
