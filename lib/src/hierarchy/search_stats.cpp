// SPDX-License-Identifier: MIT
#include <dch/hierarchy/search_stats.hpp>

namespace dch {

SearchStats& SearchStats::operator+=(const SearchStats& other) {
  builds += other.builds;
  refreshes += other.refreshes;
  repairs += other.repairs;
  promotions += other.promotions;
  demotions += other.demotions;
  reparented += other.reparented;
  distances += other.distances;
  visited += other.visited;
  inserted += other.inserted;
  removed += other.removed;
  return *this;
}

}  // namespace dch
