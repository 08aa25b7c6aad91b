// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace dch::detail {

/// Steps of the Fourier transform of a length: its factors and what outputs of each step are multiplied by.
struct FftPlan {
  struct Step {
    int radix, rows;              ///< sets of so many elements, and number of sets
    std::vector<float> twiddles;  ///< cosine and sine of 2 pi p k / (radix rows), for set p and output k
  };
  std::vector<Step> steps;

  /// @param length  has no prime factors other than 2, 3, 5 and 7
  explicit FftPlan(int length);
};

/// The least length that is not smaller and has a plan.
int next_fft_length(int length);

}  // namespace dch::detail
