// SPDX-License-Identifier: MIT
//
// The loop of moment_kernels.hpp, for the compiler to vectorize: included once for each instruction set.
#pragma once

#include "simd/moment_kernels.hpp"
#include "simd/native_doubles.hpp"

namespace dch::detail {
namespace {

// R_m^m = (x + i y) / (2 m) R_(m-1)^(m-1), and
// (l + 1 + m) (l + 1 - m) R_(l+1)^m = (2 l + 1) z R_l^m - r^2 R_(l-1)^m.
/// Of the charges from k on that fill a register, which are summed up in the lanes from `lane` on.
inline void sum_moments_of(const MomentTask& task, std::int32_t k, int lane) {
  Doubles x, y, z, real, imaginary{};
  load(task.x + k, x);
  load(task.y + k, y);
  load(task.z + k, z);
  load(task.charge + k, real);
  const Doubles r2 = x * x + y * y + z * z;
  const double* inverse = task.inverse;
  double* sums = task.sums + lane;
  for (std::int32_t m = 0; m <= task.degree; ++m) {
    if (m > 0) {
      const double half = 0.5 / m;
      const Doubles before = real;
      real = half * (before * x - imaginary * y);
      imaginary = half * (before * y + imaginary * x);
    }
    Doubles real0{}, imaginary0{}, real1 = real, imaginary1 = imaginary;
    for (std::int32_t l = m; l <= task.degree; ++l, sums += 2 * kMomentLanes) {
      Doubles of_real, of_imaginary;
      load(sums, of_real);
      load(sums + kMomentLanes, of_imaginary);
      of_real += real1;
      of_imaginary += imaginary1;
      store(of_real, sums);
      store(of_imaginary, sums + kMomentLanes);
      const double over = *inverse++;
      const Doubles of_one = (over * (2 * l + 1)) * z, of_zero = over * r2;
      const Doubles real2 = of_one * real1 - of_zero * real0,
                    imaginary2 = of_one * imaginary1 - of_zero * imaginary0;
      real0 = real1;
      imaginary0 = imaginary1;
      real1 = real2;
      imaginary1 = imaginary2;
    }
  }
}

inline void sum_moments(const MomentTask& task) {
  for (std::int32_t k = 0; k < task.count; k += kWidth) sum_moments_of(task, k, k % kMomentLanes);
}

}  // namespace
}  // namespace dch::detail
