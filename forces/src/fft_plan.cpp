// SPDX-License-Identifier: MIT
#include "fft_plan.hpp"

#include <cmath>

namespace dch::detail {
namespace {

constexpr int kRadices[] = {5, 7, 3, 4, 2};

FftPlan::Step make_step(int radix, int length) {
  FftPlan::Step step{radix, length / radix, {}};
  const double unit = 2 * std::acos(-1.0) / length;
  for (int p = 0; p < step.rows; ++p)
    for (int k = 0; k < radix; ++k) {
      step.twiddles.push_back(static_cast<float>(std::cos(unit * p * k)));
      step.twiddles.push_back(static_cast<float>(std::sin(unit * p * k)));
    }
  return step;
}

}  // namespace

FftPlan::FftPlan(int length) {
  for (const int radix : kRadices)
    for (; length % radix == 0; length /= radix) steps.push_back(make_step(radix, length));
}

int next_fft_length(int length) {
  for (;; ++length) {
    int left = length;
    for (const int radix : kRadices)
      while (left % radix == 0) left /= radix;
    if (left == 1) return length;
  }
}

}  // namespace dch::detail
