// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <dch/base/instruction_set.hpp>

namespace dch::detail {

/// Charges that kernels take at once.
inline constexpr int kMomentLanes = 8;

/// Regular solid harmonics r^l P_l^m exp(i m phi) / (l + m)! of some places times charges, summed up. Results
/// are the same with any instruction set, to the last bit: which nodes are far depends on them.
struct MomentTask {
  std::int32_t degree;
  const double *x, *y, *z, *charge;
  std::int32_t count;     ///< a multiple of kMomentLanes; the rest has charge 0
  const double* inverse;  ///< by m, then l from m on to the degree: 1 / ((l + 1 + m) (l + 1 - m))
  double* sums;           ///< in the same order: kMomentLanes of the real part, and of the imaginary one
};

using MomentKernel = void (*)(const MomentTask& task);

/// That of a set that is supported.
MomentKernel moment_kernel(InstructionSet set);

extern const MomentKernel kMomentsPortable;
#ifdef DCH_X86_KERNELS
extern const MomentKernel kMomentsAvx2, kMomentsAvx512;
#endif

}  // namespace dch::detail
