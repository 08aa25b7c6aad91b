// SPDX-License-Identifier: MIT
#include "engines/neighbor_distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dch::cli {

double neighbor_distance(Span<const Vec3> positions, const Box& box, std::int32_t k) {
  constexpr std::size_t kSamples = 9;
  const std::size_t n = positions.size();
  if (n < 2) return 0;
  const std::size_t samples = std::min(n, kSamples);
  // The point itself is the nearest of all
  const std::size_t rank = std::min(n - 1, static_cast<std::size_t>(k));
  std::vector<double> distances2(n), around;
  for (std::size_t sample = 0; sample < samples; ++sample) {
    const Vec3 center = positions[(2 * sample + 1) * n / (2 * samples)];
    for (std::size_t point = 0; point < n; ++point) {
      distances2[point] = box.distance2(center, positions[point]);
    }
    std::nth_element(distances2.begin(), distances2.begin() + static_cast<std::ptrdiff_t>(rank),
                     distances2.end());
    around.push_back(distances2[rank]);
  }
  std::nth_element(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(samples / 2), around.end());
  return std::sqrt(around[samples / 2]);
}

}  // namespace dch::cli
