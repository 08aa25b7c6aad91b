// SPDX-License-Identifier: MIT
#include <algorithm>

#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>

namespace dch {

std::int64_t NeighborList::pairs() const {
  if (kind == ListKind::half) return first.back();
  std::int64_t count = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const auto neighbors = row(i);
    const std::int32_t self = particle.empty() ? static_cast<std::int32_t>(i) : particle[i];
    count += std::count_if(neighbors.begin(), neighbors.end(),
                           [self](std::int32_t other) { return other > self; });
  }
  return count;
}

double ListParams::list_radius() const {
  if (radii.empty()) return cutoffs.largest() + skin;
  return 2 * *std::max_element(radii.begin(), radii.end()) + skin;
}

RadiusRange::RadiusRange(Span<const double> radii) {
  if (radii.empty()) return;
  const auto [low, high] = std::minmax_element(radii.begin(), radii.end());
  least = *low;
  largest = *high;
}

}  // namespace dch
