// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace dch::detail {

/// Disjoint sets of numbers 0..n-1, joined two by two. The least number of a set stands for it.
class Components {
 public:
  explicit Components(std::size_t n) : above_(n) { std::iota(above_.begin(), above_.end(), 0); }
  std::int32_t of(std::int32_t k) {
    while (above_[k] != k) k = above_[k] = above_[above_[k]];
    return k;
  }
  /// Returns false if they were in one set already.
  bool join(std::int32_t a, std::int32_t b) {
    a = of(a);
    b = of(b);
    if (a == b) return false;
    above_[std::max(a, b)] = std::min(a, b);
    return true;
  }

 private:
  std::vector<std::int32_t> above_;  ///< never larger than the number itself
};

}  // namespace dch::detail
