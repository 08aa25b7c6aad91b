// SPDX-License-Identifier: MIT
#include "simd/nearest_kernels_loops.hpp"

namespace dch::detail {

const NearestKernels kNearestAvx2{select_blocks, search_blocks};

}  // namespace dch::detail
