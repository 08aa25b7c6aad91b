// SPDX-License-Identifier: MIT
//
// The loop of moment_kernels.hpp, for the compiler to vectorize: included once for each instruction set.
#pragma once

#include "simd/moment_kernels.hpp"

namespace dch::detail {
namespace {

using MomentLanes __attribute__((vector_size(kMomentLanes * sizeof(double)))) = double;

// R_m^m = (x + i y) / (2 m) R_(m-1)^(m-1), and
// (l + 1 + m) (l + 1 - m) R_(l+1)^m = (2 l + 1) z R_l^m - r^2 R_(l-1)^m.
void sum_moments(const MomentTask& task) {
  for (std::int32_t k = 0; k < task.count; k += kMomentLanes) {
    MomentLanes x, y, z, real, imaginary{};
    __builtin_memcpy(&x, task.x + k, sizeof x);
    __builtin_memcpy(&y, task.y + k, sizeof y);
    __builtin_memcpy(&z, task.z + k, sizeof z);
    __builtin_memcpy(&real, task.charge + k, sizeof real);
    const MomentLanes r2 = x * x + y * y + z * z;
    const double* inverse = task.inverse;
    double* sums = task.sums;
    for (std::int32_t m = 0; m <= task.degree; ++m) {
      if (m > 0) {
        const double half = 0.5 / m;
        const MomentLanes before = real;
        real = half * (before * x - imaginary * y);
        imaginary = half * (before * y + imaginary * x);
      }
      MomentLanes real0{}, imaginary0{}, real1 = real, imaginary1 = imaginary;
      for (std::int32_t l = m; l <= task.degree; ++l, sums += 2 * kMomentLanes) {
        MomentLanes of_real, of_imaginary;
        __builtin_memcpy(&of_real, sums, sizeof of_real);
        __builtin_memcpy(&of_imaginary, sums + kMomentLanes, sizeof of_imaginary);
        of_real += real1;
        of_imaginary += imaginary1;
        __builtin_memcpy(sums, &of_real, sizeof of_real);
        __builtin_memcpy(sums + kMomentLanes, &of_imaginary, sizeof of_imaginary);
        const double over = *inverse++;
        const MomentLanes of_one = (over * (2 * l + 1)) * z, of_zero = over * r2;
        const MomentLanes real2 = of_one * real1 - of_zero * real0,
                          imaginary2 = of_one * imaginary1 - of_zero * imaginary0;
        real0 = real1;
        imaginary0 = imaginary1;
        real1 = real2;
        imaginary1 = imaginary2;
      }
    }
  }
}

}  // namespace
}  // namespace dch::detail
