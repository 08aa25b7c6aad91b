// SPDX-License-Identifier: MIT
#include "mesh_influence.hpp"

#include <cmath>
#include <numbers>

namespace dch::detail {
namespace {

using std::numbers::pi;

/// Squared absolute values of the Fourier transform of the spline on so many points.
std::vector<double> spline_moduli(int size, const detail::MeshKernels& kernels) {
  float weight[detail::kSplineRow], slope[detail::kSplineRow];
  kernels.spline(0, weight, slope);
  std::vector<double> moduli;
  for (int m = 0; m < size; ++m) {
    double re = 0, im = 0;
    for (int k = 0; k < detail::kSplineOrder; ++k) {
      re += double{weight[k]} * std::cos(2 * pi * m * k / size);
      im += double{weight[k]} * std::sin(2 * pi * m * k / size);
    }
    moduli.push_back(re * re + im * im);
  }
  // Splines of odd order have none of the shortest wave, which no mesh can tell from its neighbors.
  const auto n = moduli.size();
  for (std::size_t m = 0; m < n; ++m)
    if (moduli[m] < 1e-7) moduli[m] = 0.5 * (moduli[(m + n - 1) % n] + moduli[(m + 1) % n]);
  return moduli;
}

/// Of a wave number on a mesh of so many points.
double centered(int m, int size) { return m < (size + 1) / 2 ? m : m - size; }

}  // namespace

std::array<Vec3, 3> reciprocal_vectors(const Box& box) {
  std::array<Vec3, 3> vectors;
  for (int k = 0; k < 3; ++k) {
    const Vec3 normal = cross(box.vector((k + 1) % 3), box.vector((k + 2) % 3));
    vectors[static_cast<std::size_t>(k)] = (1 / dot(box.vector(k), normal)) * normal;
  }
  return vectors;
}

MeshInfluence::MeshInfluence(const std::array<int, 3>& sizes, LatticeWeights weights,
                             const MeshKernels& kernels)
    : sizes_(sizes), weights_(weights) {
  for (std::size_t axis = 0; axis < 3; ++axis) moduli_[axis] = spline_moduli(sizes[axis], kernels);
}

void MeshInfluence::set_box(const Box& box) {
  reciprocal_ = reciprocal_vectors(box);
  const double a = weights_.splitting;
  scale_ = weights_.of == LatticeSum::coulomb
               ? weights_.constant / (pi * box.volume())
               : -weights_.constant * pi * std::sqrt(pi) * a * a * a / (3 * box.volume());
}

/// Of a wave m, with b = pi |m| / splitting: constant e^(-b^2) / (pi volume m^2), or of dispersion -constant
/// (sqrt(pi) splitting)^3 / (3 volume) ((1 - 2 b^2) e^(-b^2) + 2 sqrt(pi) b^3 erfc(b)). 0 for m = 0.
double MeshInfluence::weight(double x, double y, double z) const {
  const double m2 = norm2(x * reciprocal_[0] + y * reciprocal_[1] + z * reciprocal_[2]);
  if (m2 == 0) return 0;
  const double b2 = pi * pi * m2 / (weights_.splitting * weights_.splitting);
  if (weights_.of == LatticeSum::coulomb) return scale_ * std::exp(-b2) / m2;
  const double b = std::sqrt(b2);
  return scale_ * ((1 - 2 * b2) * std::exp(-b2) + 2 * std::sqrt(pi) * b2 * b * std::erfc(b));
}

/// Weights over the moduli of splines. The shortest wave along an axis of even size has two signs, which a
/// mesh cannot tell apart: the mean of both, so that waves and their mirror images weigh the same.
void MeshInfluence::fill_plane(int x, float* at) const {
  const double wx = centered(x, sizes_[0]);
  for (int z = 0; z < sizes_[2]; ++z)
    for (int y = 0; y < sizes_[1]; ++y) {
      const double wy = centered(y, sizes_[1]), wz = centered(z, sizes_[2]);
      const bool both[3] = {2 * x == sizes_[0], 2 * y == sizes_[1], 2 * z == sizes_[2]};
      double mean = weight(wx, wy, wz);
      if (both[0] || both[1] || both[2]) {
        mean = 0;
        for (int signs = 0; signs < 8; ++signs)
          mean += weight(both[0] && (signs & 1) ? -wx : wx, both[1] && (signs & 2) ? -wy : wy,
                         both[2] && (signs & 4) ? -wz : wz) /
                  8;
      }
      *at++ = static_cast<float>(
          mean / (moduli_[0][static_cast<std::size_t>(x)] * moduli_[1][static_cast<std::size_t>(y)] *
                  moduli_[2][static_cast<std::size_t>(z)]));
    }
}

}  // namespace dch::detail
