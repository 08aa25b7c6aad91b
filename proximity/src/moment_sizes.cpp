// SPDX-License-Identifier: MIT
#include "moment_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dch::detail {

// C_l^m = sqrt((l - m)! (l + m)!) R_l^m, and -m has the same size as m.
MeasureMoments::MeasureMoments(int degree) : degree_(degree), kernel_(moment_kernel(instruction_set())) {
  for (int m = 0; m <= degree; ++m)
    for (int l = m; l <= degree; ++l) {
      inverse_.push_back(1.0 / ((l + 1 + m) * (l + 1 - m)));
      double ratio = m > 0 ? 2 : 1;  // (l - m)! (l + m)! / l!^2
      for (int k = 1; k <= m; ++k) ratio *= static_cast<double>(l + k) / (l - k + 1);
      squares_.push_back(ratio);
    }
  sums_.resize(2 * kMomentLanes * inverse_.size());
}

void MeasureMoments::clear() {
  for (auto* array : {&x_, &y_, &z_, &charge_}) array->clear();
}

void MeasureMoments::add(double charge, Vec3 from_center) {
  charge_.push_back(charge);
  x_.push_back(from_center.x);
  y_.push_back(from_center.y);
  z_.push_back(from_center.z);
}

MomentSizes MeasureMoments::sizes(double of_absolute) {
  while (charge_.size() % kMomentLanes != 0) add(0, {});
  std::fill(sums_.begin(), sums_.end(), 0.0);
  kernel_({degree_, x_.data(), y_.data(), z_.data(), charge_.data(),
           static_cast<std::int32_t>(charge_.size()), inverse_.data(), sums_.data()});
  std::array<double, kMaxDegree + 1> squares{};  // these lack l!^2, and sizes are to be over l!
  const double* lane = sums_.data();
  std::size_t k = 0;
  for (int m = 0; m <= degree_; ++m)
    for (int l = m; l <= degree_; ++l, ++k) {
      double real = 0, imaginary = 0;
      for (int j = 0; j < kMomentLanes; ++j) real += *lane++;
      for (int j = 0; j < kMomentLanes; ++j) imaginary += *lane++;
      squares[static_cast<std::size_t>(l)] += squares_[k] * (real * real + imaginary * imaginary);
    }
  MomentSizes sizes{};
  double over_factorial = of_absolute;
  for (std::size_t l = 0; l <= static_cast<std::size_t>(degree_); ++l) {
    if (l > 0) over_factorial /= static_cast<double>(l);
    sizes[l] = static_cast<float>(std::sqrt(squares[l]) * (1 + 1e-6) + 1e-12 * over_factorial);
  }
  return sizes;
}

}  // namespace dch::detail
