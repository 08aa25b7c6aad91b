// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lists/pair_filter.hpp"
#include "simd/list_kernels.hpp"

namespace dch::detail {

/// Limits of the squared distances of one list's pairs in the arithmetic of ListKernels. Between `in` and
/// `out` lies what its rounding leaves open.
struct ListLimits {
  /// @param point_unit of the coordinates [length]
  /// @param reach of pairs of particles at most, where cutoffs go by radii or types [length]: no filter lets
  ///   points pass that are farther, but for rounding
  /// @param error how far the distance of two positions may be from their pair distance [length]
  /// @param shift_error how much the shift between two points is off along an axis, at most [units]
  ListLimits(const PairFilter& filter, double point_unit, double reach, double error,
             double shift_error = 0.5);

  struct PairLimits {
    std::int16_t in = 0, out = 0;               ///< by one cutoff; by types if per_pair
    std::int16_t band = 0;                      ///< by radii, and of all types
    std::int16_t skin = 0;                      ///< by radii, to be added to the size of a row [units]
    std::vector<TypeLimits> type_in, type_out;  ///< by types
    /// By types: no pair's `in` or `out` is farther from its middle than `band`; of types that make no pair
    /// the middle is below all.
    std::vector<TypeLimits> type_middle;
  };

  /// As the kernels take them.
  /// @param take_open what rounding leaves open is taken, and nothing is open
  RowLimits for_rows(const PairLimits& pairs, bool take_open) const;

  CutoffBy by;
  PairLimits all;
  /// Of those that come first in their row; `in` and `out` are the same, so nothing is left open.
  PairLimits near;
  bool has_shell = false;
  bool per_pair =
      false;  ///< types are more than the kernels can tell apart: all.out is for all, all.in for none
  /// By one cutoff, the cutoff [units]. A pair whose distance by its coordinates is farther from its cutoff
  /// than `off` is decided by that; only sums of squares that are not rounded tell so much.
  double cutoff = 0, off = 0;
  std::vector<std::array<double, kKernelTypes>> type_cutoff;  ///< by types [units]
  TypeLimits farthest{};                                      ///< by types: the largest for each
  double margin = 0;  ///< how far beyond its cutoff a pair left open may be [length]
};

/// For pairs that are taken up to their reach, and a little beyond.
struct ReachLimit {
  std::int16_t out;  ///< above the sum of squares of all pairs within the reach
  double margin;     ///< how far beyond the reach a pair with a smaller sum may be [length]
};
/// @param point_unit of the coordinates [length]
/// @param shift_error as of ListLimits
ReachLimit limit_of_reach(double reach, double point_unit, double shift_error);

}  // namespace dch::detail
