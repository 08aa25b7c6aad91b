// SPDX-License-Identifier: MIT
#include "frozen/frozen_kernels_loops.hpp"

namespace dch::bench {
namespace {

/// One lane at a time.
struct Portable {
  using V = std::int16_t;
  static constexpr int kLanes = 1;
  static constexpr std::uint32_t kAll = 1;

  static V saturated(int v) { return static_cast<V>(v > 32767 ? 32767 : v < -32768 ? -32768 : v); }
  static V load(const std::int16_t* p) { return *p; }
  static V set1(std::int16_t v) { return v; }
  static V sub(V a, V b) {
    return static_cast<V>(static_cast<std::uint16_t>(a) - static_cast<std::uint16_t>(b));
  }
  static V adds(V a, V b) { return saturated(a + b); }
  static V abs(V a) { return static_cast<V>(a < 0 ? -a : a); }
  static V above(V a, V b) { return a > b ? static_cast<V>(a - b) : V{0}; }  // of numbers >= 0
  // -32768 squared does not fit: it comes out as -32768, as in the vector instruction
  static V square(V d) { return static_cast<V>(static_cast<std::uint16_t>((d * d + 0x4000) >> 15)); }
  static std::uint32_t bits_greater(V a, V b) { return a > b; }

  static std::int32_t move_to_front(std::uint32_t lane, V px, V py, V pz, const std::int32_t* from,
                                    std::int16_t* x, std::int16_t* y, std::int16_t* z, std::int32_t* to) {
    *x = px;
    *y = py;
    *z = pz;
    *to = *from;
    return static_cast<std::int32_t>(lane);
  }
  static constexpr int kIds = 1;
  static std::uint32_t equal_ids(const std::int32_t* ids, std::int32_t id) { return *ids == id; }
  static std::int32_t compress_ids(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    *out = *ids;
    return static_cast<std::int32_t>(mask);
  }
  static std::int32_t compress_chunk(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    std::int32_t written = 0;
    for (; mask != 0; mask &= mask - 1) out[written++] = ids[__builtin_ctz(mask)];
    return written;
  }
};

}  // namespace

const FrozenKernels& frozen_kernels(InstructionSet set) {
  switch (set) {
#ifdef DCH_X86_KERNELS
    case InstructionSet::avx2:
      return frozen_kernels_avx2();
    case InstructionSet::avx512:
      return frozen_kernels_avx512();
#endif
    default:
      return frozen_kernels_portable();
  }
}

const FrozenKernels& frozen_kernels_portable() {
  static constexpr FrozenKernels kKernels = kernels_of<Portable>;
  return kKernels;
}

}  // namespace dch::bench
