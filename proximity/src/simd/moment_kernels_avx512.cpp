// SPDX-License-Identifier: MIT
#include "simd/moment_kernels_loops.hpp"

namespace dch::detail {

const MomentKernel kMomentsAvx512 = sum_moments;

}  // namespace dch::detail
