// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "pair_filter.hpp"
#include "simd/list_kernels.hpp"

namespace dch::detail {

/// Limits of the squared distances of one list's pairs in the arithmetic of ListKernels. Between `in` and
/// `out` lies what its rounding leaves open.
struct ListLimits {
  /// @param point_unit of the coordinates [length]
  /// @param error how far the distance of two positions may be from their pair distance [length]
  ListLimits(const PairFilter& filter, double point_unit, double error);

  PairFilter::By by;
  bool per_pair = false;  ///< types are more than the kernels can tell apart: `out` is for all, `in` for none
  std::int16_t in = 0, out = 0;  ///< by one cutoff; by types if per_pair
  /// For sums of squares that are not rounded [units^2]: up to `sure_in` a pair is in the list, from
  /// `sure_out` on it is not. By one cutoff; else all are left open.
  std::int64_t sure_in = -1, sure_out = std::numeric_limits<std::int64_t>::max();
  std::int16_t band = 0;                      ///< by radii
  std::int16_t skin = 0;                      ///< by radii, to be added to the size of a row [units]
  std::vector<TypeLimits> type_in, type_out;  ///< by types
  TypeLimits farthest{};                      ///< by types: the largest for each
  double margin = 0;                          ///< how far beyond its cutoff a pair left open may be [length]
};

}  // namespace dch::detail
