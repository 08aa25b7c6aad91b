// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/instruction_set.hpp>

#include "simd/embedded_task.hpp"

namespace dch::detail {

/// The loops of embedded atoms, compiled for one instruction set.
struct EmbeddedKernels {
  void (*densities)(EmbeddedTask& task);
  void (*forces)(EmbeddedTask& task);
};

/// How many second atoms kernels write beyond the last one.
inline constexpr int kBeyondNear = 16;

/// The kernels of a set that is supported.
const EmbeddedKernels& embedded_kernels(InstructionSet set);

}  // namespace dch::detail
