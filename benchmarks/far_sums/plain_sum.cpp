// SPDX-License-Identifier: MIT
#include <cmath>

#include "direct_sums.hpp"

namespace dch::bench {

double plain_potential(const DirectCharges& charges, double x, double y, double z) {
  double sum = 0;
  for (std::size_t k = 0; k < charges.count; ++k) {
    const double dx = charges.x[k] - x, dy = charges.y[k] - y, dz = charges.z[k] - z;
    const double r2 = dx * dx + dy * dy + dz * dz;
    sum += r2 > 0 ? charges.q[k] / std::sqrt(r2) : 0.0;
  }
  return sum;
}

}  // namespace dch::bench
