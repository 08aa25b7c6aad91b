// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/neighbor_list.hpp>
#include <dch/span.hpp>

namespace dch::detail {

/// Particles sorted into classes of about the same size, and how far those of two classes look for each
/// other.
struct SizeClasses {
  /// Classes for lists of n particles; the first request decides.
  /// @param farthest list radius up to which classes can be told apart [length]; beyond it there is one
  SizeClasses(Span<const ListParams> requests, std::size_t n, double farthest);

  double reach_of(std::size_t a, std::size_t b) const { return reach[a * count + b]; }

  std::size_t count = 1;         ///< the smallest first
  std::vector<std::int32_t> of;  ///< class of each particle
  std::vector<double> reach;     ///< largest list radius of a pair, count x count [length]
};

}  // namespace dch::detail
