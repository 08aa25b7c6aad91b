// SPDX-License-Identifier: MIT
//
// Fourier transforms of many lines side by side, by Stockham's steps, which need no other order of elements.
// Loops run over the lines, so that compilers make vectors of them.
#pragma once

#include <cmath>
#include <utility>

#include "simd/mesh_task.hpp"

namespace dch::detail {
namespace {

/// Cosines and sines of 2 pi j k / kRadix.
template <int kRadix>
struct Roots {
  float cosine[kRadix][kRadix], sine[kRadix][kRadix];
  explicit Roots(float sign) {
    for (int j = 0; j < kRadix; ++j)
      for (int k = 0; k < kRadix; ++k) {
        const double angle = 2 * std::acos(-1.0) * (j * k % kRadix) / kRadix;
        cosine[j][k] = static_cast<float>(std::cos(angle));
        sine[j][k] = sign * static_cast<float>(std::sin(angle));
      }
  }
};

template <int kRadix>
struct Elements {
  float re[kRadix], im[kRadix];
};

/// Odd radices: inputs j and kRadix - j have the same cosines, and opposite sines.
template <int kRadix>
Elements<kRadix> butterfly(const Elements<kRadix>& x, const Roots<kRadix>& roots, float) {
  constexpr int kHalf = (kRadix - 1) / 2;
  Elements<kRadix> y;
  Elements<kHalf> sum, difference;
  y.re[0] = x.re[0];
  y.im[0] = x.im[0];
  for (int j = 0; j < kHalf; ++j) {
    sum.re[j] = x.re[j + 1] + x.re[kRadix - 1 - j];
    sum.im[j] = x.im[j + 1] + x.im[kRadix - 1 - j];
    difference.re[j] = x.re[j + 1] - x.re[kRadix - 1 - j];
    difference.im[j] = x.im[j + 1] - x.im[kRadix - 1 - j];
    y.re[0] += sum.re[j];
    y.im[0] += sum.im[j];
  }
  for (int k = 1; k <= kHalf; ++k) {
    float even_re = x.re[0], even_im = x.im[0], odd_re = 0, odd_im = 0;
    for (int j = 0; j < kHalf; ++j) {
      even_re += roots.cosine[j + 1][k] * sum.re[j];
      even_im += roots.cosine[j + 1][k] * sum.im[j];
      odd_re -= roots.sine[j + 1][k] * difference.im[j];
      odd_im += roots.sine[j + 1][k] * difference.re[j];
    }
    y.re[k] = even_re + odd_re;
    y.im[k] = even_im + odd_im;
    y.re[kRadix - k] = even_re - odd_re;
    y.im[kRadix - k] = even_im - odd_im;
  }
  return y;
}

inline Elements<2> butterfly(const Elements<2>& x, const Roots<2>&, float) {
  return {{x.re[0] + x.re[1], x.re[0] - x.re[1]}, {x.im[0] + x.im[1], x.im[0] - x.im[1]}};
}

inline Elements<4> butterfly(const Elements<4>& x, const Roots<4>&, float sign) {
  const float a_re = x.re[0] + x.re[2], a_im = x.im[0] + x.im[2];
  const float b_re = x.re[0] - x.re[2], b_im = x.im[0] - x.im[2];
  const float c_re = x.re[1] + x.re[3], c_im = x.im[1] + x.im[3];
  const float d_re = -sign * (x.im[1] - x.im[3]), d_im = sign * (x.re[1] - x.re[3]);  // times i
  return {{a_re + c_re, b_re + d_re, a_re - c_re, b_re - d_re},
          {a_im + c_im, b_im + d_im, a_im - c_im, b_im - d_im}};
}

/// From element p + rows j to element kRadix p + k: the sum over j of e^(sign 2 pi i j k / kRadix) times the
/// inputs, times the twiddle factor. Elements are `width` numbers each.
template <int kRadix>
void fft_step(const FftPlan::Step& step, std::size_t width, float sign, ComplexArray from, ComplexArray to) {
  const Roots<kRadix> roots(sign);
  for (int p = 0; p < step.rows; ++p) {
    Elements<kRadix> twiddle;
    ComplexArray in[kRadix], out[kRadix];
    for (int k = 0; k < kRadix; ++k) {
      const std::size_t number = 2 * static_cast<std::size_t>(kRadix * p + k);
      twiddle.re[k] = step.twiddles[number];
      twiddle.im[k] = sign * step.twiddles[number + 1];
      const std::size_t source = width * static_cast<std::size_t>(p + step.rows * k);
      const std::size_t target = width * static_cast<std::size_t>(kRadix * p + k);
      in[k] = {from.re + source, from.im + source};
      out[k] = {to.re + target, to.im + target};
    }
#ifndef __clang__  // has no such pragma, and tests at run time whether arrays overlap
#pragma GCC ivdep
#endif
    for (std::size_t q = 0; q < width; ++q) {
      Elements<kRadix> x;
      for (int k = 0; k < kRadix; ++k) {
        x.re[k] = in[k].re[q];
        x.im[k] = in[k].im[q];
      }
      const Elements<kRadix> y = butterfly(x, roots, sign);
      for (int k = 0; k < kRadix; ++k) {
        out[k].re[q] = y.re[k] * twiddle.re[k] - y.im[k] * twiddle.im[k];
        out[k].im[q] = y.re[k] * twiddle.im[k] + y.im[k] * twiddle.re[k];
      }
    }
  }
}

/// Transforms elements of `lanes` numbers each, the first of two arrays, and leaves the result in the first
/// of them, which may have changed places with the second; sign -1 forward, without a factor either way.
inline void fft(const FftPlan& plan, std::size_t lanes, float sign, ComplexArray& data, ComplexArray& other) {
  std::size_t width = lanes;
  for (const FftPlan::Step& step : plan.steps) {
    switch (step.radix) {
      case 2:
        fft_step<2>(step, width, sign, data, other);
        break;
      case 3:
        fft_step<3>(step, width, sign, data, other);
        break;
      case 4:
        fft_step<4>(step, width, sign, data, other);
        break;
      case 5:
        fft_step<5>(step, width, sign, data, other);
        break;
      default:
        fft_step<7>(step, width, sign, data, other);
    }
    std::swap(data, other);
    width *= static_cast<std::size_t>(step.radix);
  }
}

}  // namespace
}  // namespace dch::detail
