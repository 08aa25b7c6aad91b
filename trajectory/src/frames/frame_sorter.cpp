// SPDX-License-Identifier: MIT
#include "frames/frame_sorter.hpp"

#include <algorithm>
#include <functional>

namespace dch::trajectory {

std::optional<RepeatedId> FrameSorter::sort_by_id(Frame& frame) {
  const auto& ids = frame.ids;
  if (std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) == ids.end()) return std::nullopt;

  order_.clear();
  for (const std::int64_t id : ids) order_.emplace_back(id, static_cast<std::int32_t>(order_.size()));
  std::sort(order_.begin(), order_.end());
  const auto same_id = [](const auto& a, const auto& b) { return a.first == b.first; };
  const auto repeated = std::adjacent_find(order_.begin(), order_.end(), same_id);
  if (repeated != order_.end()) return RepeatedId{repeated->first, repeated->second, repeated[1].second};

  reorder(frame.ids);
  reorder(frame.positions);
  reorder(frame.types);
  reorder(frame.molecules);
  reorder(frame.images);
  return std::nullopt;
}

template <class T>
void FrameSorter::reorder(std::vector<T>& values) const {
  if (values.empty()) return;
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (const auto& [id, place] : order_) sorted.push_back(values[static_cast<std::size_t>(place)]);
  values.swap(sorted);
}

}  // namespace dch::trajectory
