// SPDX-License-Identifier: MIT
#include "hierarchy/build/base_radius.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "geometry/metric.hpp"

namespace dch::detail {
namespace {

constexpr std::size_t kSamples = 9;       ///< points around which others are counted
constexpr std::size_t kMinOthers = 4096;  ///< points that are counted, or one in kStride if that is more
constexpr std::size_t kStride = 16;
// Of the points within R_0 of a center about a third are its children.
constexpr double kPointsWithinRadius = 300;
constexpr double kMinFactor = 0.25, kMaxFactor = 4;  ///< R_0 / radius

std::size_t counted_points(std::size_t n) { return std::min(n, std::max(kMinOthers, n / kStride)); }

}  // namespace

std::int64_t density_samples(std::size_t points) {
  return static_cast<std::int64_t>(kSamples * counted_points(points));
}

double base_radius_for(Span<const Vec3> positions, const Box& box, double radius) {
  const std::size_t n = positions.size();
  const double most = std::min(kMaxFactor * radius, std::max(box.max_cutoff(), kMinFactor * radius));
  if (n < 2) return radius;
  const std::size_t others = counted_points(n);
  const double share = static_cast<double>(others) / static_cast<double>(n);
  const auto nth = std::min(others - 1, static_cast<std::size_t>(std::ceil(kPointsWithinRadius * share)));
  std::vector<double> medians, distances2(others);
  with_metric(box, [&](const auto& metric) {
    std::vector<Vec3> wrapped(others);
    for (std::size_t k = 0; k < others; ++k) wrapped[k] = box.wrap(positions[k * n / others]);
    for (std::size_t s = 0; s < kSamples; ++s) {
      const Vec3 center = box.wrap(positions[(2 * s + 1) * n / (2 * kSamples)]);
      for (std::size_t k = 0; k < others; ++k) distances2[k] = metric.distance2(center, wrapped[k]);
      std::nth_element(distances2.begin(), distances2.begin() + static_cast<std::ptrdiff_t>(nth),
                       distances2.end());
      medians.push_back(distances2[nth]);
    }
  });
  std::nth_element(medians.begin(), medians.begin() + kSamples / 2, medians.end());
  return std::clamp(std::sqrt(medians[kSamples / 2]), kMinFactor * radius, most);
}

}  // namespace dch::detail
