// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>

#include "multi_indices.hpp"
#include "simd/moment_kernels.hpp"

namespace dch::detail {

/// Sizes of moments are measured up to this degree.
inline constexpr int kMaxDegree = kMaxOrder + 4;

/// By degree.
using MomentSizes = std::array<float, kMaxDegree + 1>;

/// How large the moments of some charges are, degree by degree: the root of the sum over m of
/// |sum over charges of q r^l C_l^m|^2, with Racah's normalization, in which the sum over m of |C_l^m|^2 is 1
/// (the addition theorem). So it is at most the sum of |q| r^l, and far smaller where charges are of both
/// signs, or lie around their center on all sides.
class MeasureMoments {
 public:
  /// @param degree at most kMaxDegree
  explicit MeasureMoments(int degree);

  void clear();
  void add(double charge, Vec3 from_center);

  /// Of what was added since clear(), over the factorial of the degree, as translations take them. Rounded
  /// up.
  /// @param of_absolute the sum over |q|, of which rounding may leave a part
  MomentSizes sizes(double of_absolute);

 private:
  int degree_;
  MomentKernel kernel_;
  std::vector<double> inverse_, squares_;  ///< in the order of sums
  std::vector<double> sums_;
  std::vector<double> x_, y_, z_, charge_;
};

}  // namespace dch::detail
