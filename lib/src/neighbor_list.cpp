// SPDX-License-Identifier: MIT
#include <algorithm>

#include <dch/neighbor_list.hpp>

namespace dch {

std::int64_t NeighborList::pairs() const {
  if (kind == ListKind::half) return first.back();
  std::int64_t count = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const auto neighbors = row(i);
    count +=
        neighbors.end() - std::upper_bound(neighbors.begin(), neighbors.end(), static_cast<std::int32_t>(i));
  }
  return count;
}

}  // namespace dch
