// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>

namespace dch {

/// Where points are, to tell which of them have changed.
class Places {
 public:
  std::vector<std::int32_t> changed(const HierarchyView& view) {
    std::vector<std::int32_t> ids;
    std::vector<std::pair<bool, Vec3>> now;
    for (std::int32_t id = 0; id < static_cast<std::int32_t>(view.capacity()); ++id) {
      const auto k = static_cast<std::size_t>(id);
      now.emplace_back(view.contains(id), view.contains(id) ? view.position(id) : Vec3{});
      if (k >= places_.size() || places_[k] != now[k]) ids.push_back(id);
    }
    places_ = std::move(now);
    return ids;
  }

 private:
  std::vector<std::pair<bool, Vec3>> places_;
};

}  // namespace dch
