// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <dch/base/error.hpp>
#include <dch/base/span.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>

namespace dch::detail {

/// @throws InvalidParameter for an id beyond those of the hierarchy.
inline void check_changed(Span<const std::int32_t> changed, const HierarchyView& view) {
  for (const std::int32_t id : changed)
    if (id < 0 || static_cast<std::size_t>(id) >= view.capacity())
      throw InvalidParameter("point " + std::to_string(id) + " is said to have changed, and ids are 0.." +
                             std::to_string(view.capacity()) +
                             " (exclusive); name those of points that came, went or moved");
}

}  // namespace dch::detail
