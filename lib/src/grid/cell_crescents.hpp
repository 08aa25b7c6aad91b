// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

#include "grid/cell_layer.hpp"
#include "lists/unlisted_pairs.hpp"

namespace dch::detail {

/// Finds the points of a layer that lie in a crescent: what LeafCrescents is for a hierarchy.
class CellCrescents {
 public:
  /// @param layer with rounded coordinates
  /// @param positions of the points, as given
  CellCrescents(CellLayer& layer, Span<const Vec3> positions, const Box& box);

  /// Whether `test(i)` is true of a particle in the crescent; it is asked about a few more.
  using Test = std::function<bool(std::int32_t i)>;
  bool any(const Crescent& crescent, const Test& test) const;

 private:
  /// The crescent in the units of the layer, modulo 2^16, moved by whole periods.
  struct Rounded {
    RoundedPoint then, now;
    float inner2, outer2;
  };
  bool any_of_all(const Crescent& crescent, const Test& test) const;
  bool any_in_row(const Rounded& rounded, std::int32_t y, std::int32_t z, std::int32_t first,
                  std::int32_t last, const Test& test) const;
  bool any_in_run(const Rounded& rounded, Vec3 by, CellLayer::Run run, const Test& test) const;

  CellLayer& layer_;
  Span<const Vec3> positions_;
  const Box& box_;
  double farthest_;  ///< largest crescent that is looked for in cells [length]
};

}  // namespace dch::detail
