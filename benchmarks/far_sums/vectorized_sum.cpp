// SPDX-License-Identifier: MIT
#include <cmath>

#include "direct_sums.hpp"

namespace dch::bench {

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
double
vectorized_potential(const DirectCharges& charges, double x, double y, double z) {
  double sum = 0;
  for (std::size_t k = 0; k < charges.count; ++k) {
    const double dx = charges.x[k] - x, dy = charges.y[k] - y, dz = charges.z[k] - z;
    const double r2 = dx * dx + dy * dy + dz * dz;
    const double none = r2 > 0 ? 0.0 : 1e300;  // GCC would leave a branch about the division
    sum += charges.q[k] / std::sqrt(r2 + none);
  }
  return sum;
}

}  // namespace dch::bench
