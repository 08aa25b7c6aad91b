// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace dch::detail {

inline constexpr int kMaxOrder = 14;  ///< of expansions

/// Exponents of the monomials x^a y^b z^c, by ascending degree.
struct MultiIndex {
  int a = 0, b = 0, c = 0;
  int degree() const { return a + b + c; }
};

inline MultiIndex operator+(MultiIndex i, MultiIndex j) { return {i.a + j.a, i.b + j.b, i.c + j.c}; }

/// All of them up to a degree, with c limited.
class MultiIndices {
 public:
  MultiIndices(int order, int most_c) : side_(order + 1) {
    const auto side = static_cast<std::size_t>(side_);
    place_.assign(side * side * side, -1);
    for (int degree = 0; degree <= order; ++degree) {
      for (int c = 0; c <= degree && c <= most_c; ++c)
        for (int b = 0; b + c <= degree; ++b) {
          const MultiIndex index{degree - b - c, b, c};
          place_[cell(index)] = static_cast<int>(all_.size());
          all_.push_back(index);
        }
      up_to_.push_back(static_cast<int>(all_.size()));
    }
  }

  int size() const { return static_cast<int>(all_.size()); }
  MultiIndex operator[](int k) const { return all_[static_cast<std::size_t>(k)]; }
  const std::vector<MultiIndex>& all() const { return all_; }
  /// The place of one that there is.
  int place(MultiIndex index) const { return place_[cell(index)]; }
  /// How many there are up to a degree.
  int up_to(int degree) const { return up_to_[static_cast<std::size_t>(degree)]; }

 private:
  std::size_t cell(MultiIndex index) const {
    const int place = (index.a * side_ + index.b) * side_ + index.c;
    return static_cast<std::size_t>(place);
  }

  int side_;
  std::vector<MultiIndex> all_;
  std::vector<int> place_, up_to_;
};

}  // namespace dch::detail
