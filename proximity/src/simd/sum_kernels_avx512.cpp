// SPDX-License-Identifier: MIT
#include "simd/sum_kernels_loops.hpp"

namespace dch::detail {

const SumKernels kSumAvx512{translate, potential};

}  // namespace dch::detail
