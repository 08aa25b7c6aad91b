// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "crossing/exact_crossings.hpp"
#include "crossing/pair_motion.hpp"

namespace dch::necklace::detail {

/// What doubles say of the passages of a motion.
struct CubicPassages {
  std::array<Passage, 3> passages{};
  int count = 0;
  /// Whether all signs that decide are beyond what rounding may do. If not, the passages mean nothing.
  bool certain = true;
  bool without_root = false;  ///< the coefficients have one sign
};

/// The passages by the cubic det[b_P(t), b_Q(t), q(t) - p(t)] in Bernstein form, whose roots are isolated by
/// the signs of its coefficients and halving. Each sign counts only beyond a bound on its error.
CubicPassages cubic_passages(const PairMotion& motion);

}  // namespace dch::necklace::detail
