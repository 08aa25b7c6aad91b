// SPDX-License-Identifier: MIT
//
// The loops of sum_kernels.hpp, for the compiler to vectorize: included once for each instruction set. No
// function of a library is called, since one compiled for a wider set could then be linked into all.
#pragma once

#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include "simd/native_doubles.hpp"
#include "simd/sum_kernels.hpp"

namespace dch::detail {
namespace {

/// 1 / sqrt(a) for positive normal numbers: a guess by its exponent, off by at most 3.5 %, and four steps of
/// Newton, each of which squares that and multiplies by 1.5. With AVX-512 the guess is off by 2^-14 at most.
inline void inverse_root(const Doubles& a, Doubles& y) {
#ifdef __AVX512F__
  y = reinterpret_cast<Doubles>(_mm512_rsqrt14_pd(reinterpret_cast<__m512d>(a)));
  constexpr int kSteps = 2;
#else
  constexpr int kSteps = 4;
  Words bits;
  __builtin_memcpy(&bits, &a, sizeof bits);
  bits = 0x5FE6EB50C7B537A9u - (bits >> 1);
  __builtin_memcpy(&y, &bits, sizeof bits);
#endif
  const Doubles half = 0.5 * a;
  for (int k = 0; k < kSteps; ++k) y *= 1.5 - half * y * y;
}

/// exp(a) for a <= 0, to 2e-16 of it; below -708, of that.
inline void exponential(const Doubles& a, Doubles& result) {
  const Doubles least = Doubles{} - 708.0, x = a > least ? a : least;
  constexpr double kShift = 0x1.8p52;
  const Doubles shifted = x * 1.4426950408889634 + kShift, n = shifted - kShift;
  const Doubles f = (x - n * 0x1.62e42fefa0000p-1) - n * 0x1.cf79abc9e3b39p-40;
  Doubles sum = Doubles{} + 1.0;
  for (int k = 13; k > 0; --k) sum = 1.0 + sum * f * (1.0 / k);
  Words bits, power;
  __builtin_memcpy(&power, &shifted, sizeof power);
  __builtin_memcpy(&bits, &sum, sizeof bits);
  bits += power << 52;
  __builtin_memcpy(&result, &bits, sizeof bits);
}

/// (1/r d/dr)^k of the kernel times the distance, at distance 1: k! over odd numbers, screened or not.
inline void radial_derivatives(const TranslationTables& tables, const FarGroup& group, int lane,
                               Doubles* radial) {
  Doubles screening, before;
  load(group.decay + lane, radial[0]);
  load(group.screening + lane, screening);
  before = screening * radial[0];
  if (tables.order > 0) radial[1] = -(radial[0] + before);
  const Doubles square = screening * screening;
  for (std::int32_t k = 2; k <= tables.order; ++k)
    radial[k] = square * radial[k - 2] - static_cast<double>(2 * k - 1) * radial[k - 1];
}

/// All derivatives of the kernel, of a distance of 1; the radial ones come first.
inline void derivatives(const TranslationTables& tables, const FarGroup& group, int lane, Doubles* work) {
  radial_derivatives(tables, group, lane, work);
  Doubles direction[3];
  for (int axis = 0; axis < 3; ++axis) load(group.direction[axis] + lane, direction[axis]);
  for (std::int32_t k = 0; k < tables.steps; ++k) {
    const DerivativeStep& step = tables.step[k];
    work[step.to] = direction[step.axis] * work[step.minus_one] + step.factor * work[step.minus_two];
  }
  for (std::int32_t k = 0; k < tables.traces; ++k) {
    const std::int32_t* const trace = tables.trace + 3 * k;
    work[trace[0]] = -(work[trace[1]] + work[trace[2]]);
  }
}

/// As many values as a register holds from each of as many places, lane by lane: a transposition of blocks of
/// 1, of 2 and of 4.
inline void load_transposed(const double* const* from, std::int32_t first, Doubles* to) {
  Doubles a[kWidth];
  for (int k = 0; k < kWidth; ++k) load(from[k] + first, a[k]);
#if defined(__AVX512F__)
  Doubles b[kWidth];
  for (int k = 0; k < kWidth; k += 2) {
    b[k] = __builtin_shufflevector(a[k], a[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    b[k + 1] = __builtin_shufflevector(a[k], a[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int k = 0; k < kWidth; ++k) {
    if ((k & 2) != 0) continue;
    a[k] = __builtin_shufflevector(b[k], b[k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
    a[k + 2] = __builtin_shufflevector(b[k], b[k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
  }
  for (int k = 0; k < kWidth / 2; ++k) {
    to[k] = __builtin_shufflevector(a[k], a[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    to[k + 4] = __builtin_shufflevector(a[k], a[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
#elif defined(__AVX__)
  Doubles b[kWidth];
  for (int k = 0; k < kWidth; k += 2) {
    b[k] = __builtin_shufflevector(a[k], a[k + 1], 0, 4, 2, 6);
    b[k + 1] = __builtin_shufflevector(a[k], a[k + 1], 1, 5, 3, 7);
  }
  for (int k = 0; k < kWidth / 2; ++k) {
    to[k] = __builtin_shufflevector(b[k], b[k + 2], 0, 1, 4, 5);
    to[k + 2] = __builtin_shufflevector(b[k], b[k + 2], 2, 3, 6, 7);
  }
#else
  to[0] = __builtin_shufflevector(a[0], a[1], 0, 2);
  to[1] = __builtin_shufflevector(a[0], a[1], 1, 3);
#endif
}

inline void load_moments(const TranslationTables& tables, const FarGroup& group, int lane, Doubles* moments) {
  for (std::int32_t k = 0; k < tables.coefficients; k += kWidth)
    load_transposed(group.moments + lane, k, moments + k);
  Doubles size, power;
  load(group.source_size + lane, size);
  power = size;
  for (std::int32_t degree = 1; degree <= tables.order; ++degree) {
    for (std::int32_t k = tables.degree_end[degree - 1]; k < tables.degree_end[degree]; ++k)
      moments[k] *= power;
    power *= size;
  }
}

/// The lanes of a group that fill a register.
inline void translate_lanes(const TranslationTables& tables, const FarGroup& group, int lane, double* work,
                            double* sums) {
  auto* const moments = reinterpret_cast<Doubles*>(work);
  Doubles* const of_kernel = moments + padded(tables.coefficients);
  load_moments(tables, group, lane, moments);
  derivatives(tables, group, lane, of_kernel);
  Doubles size, power;
  load(group.target_size + lane, size);
  load(group.inverse + lane, power);
  const std::uint16_t* derivative = tables.derivative;
  for (std::int32_t degree = 0, k = 0; degree <= tables.order; ++degree) {
    const std::int32_t terms = tables.degree_end[tables.order - degree];
    for (; k < tables.degree_end[degree]; ++k, derivative += terms) {
      Doubles even{}, odd{}, local;
      std::int32_t term = 0;
      for (; term + 1 < terms; term += 2) {
        even += of_kernel[derivative[term]] * moments[term];
        odd += of_kernel[derivative[term + 1]] * moments[term + 1];
      }
      if (term < terms) even += of_kernel[derivative[term]] * moments[term];
      load(sums + k * kSumLanes + lane, local);
      local += power * (even + odd);
      store(local, sums + k * kSumLanes + lane);
    }
    power *= size;
  }
}

inline void translate(const TranslationTables& tables, const FarGroup& group, double* work, double* sums) {
  for (int lane = 0; lane < kSumLanes; lane += kWidth) translate_lanes(tables, group, lane, work, sums);
}

template <bool kScreened>
double potential_of(const NearCharges& charges, double x, double y, double z) {
  Doubles sum{};
  for (std::int32_t k = 0; k < charges.count; k += kWidth) {
    Doubles dx, dy, dz, q, inverse;
    load(charges.x + k, dx);
    load(charges.y + k, dy);
    load(charges.z + k, dz);
    load(charges.q + k, q);
    dx -= x;
    dy -= y;
    dz -= z;
    const Doubles r2 = dx * dx + dy * dy + dz * dz;
    const Doubles one = Doubles{} + 1.0, zero{};
    const auto is_other = r2 > charges.least2;
    const Doubles safe = is_other ? r2 : one;
    inverse_root(safe, inverse);
    if constexpr (kScreened) {
      Doubles decay;
      exponential(-charges.kappa * (safe * inverse), decay);
      inverse *= decay;
    }
    sum += is_other ? q * inverse : zero;
  }
  double total = 0;
  for (int lane = 0; lane < kWidth; ++lane) total += sum[lane];
  return total;
}

inline double potential(const NearCharges& charges, double x, double y, double z) {
  return charges.kappa > 0 ? potential_of<true>(charges, x, y, z) : potential_of<false>(charges, x, y, z);
}

}  // namespace
}  // namespace dch::detail
