// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Two particle indices.
using IndexPair = std::array<std::int32_t, 2>;

/// Pairs that a neighbor list leaves out. They filter the output only: the conflict graph keeps its edges,
/// since maintenance under motion needs them.
class Exclusions {
 public:
  Exclusions() = default;

  /// Excludes the given pairs; order within a pair and repetition do not matter.
  /// @throws InvalidParameter if an index is outside [0, n) or a pair names one particle twice.
  static Exclusions from_pairs(std::size_t n, Span<const IndexPair> pairs);

  /// Excludes every pair of particles joined by a path of at most `depth` bonds: depth 1 leaves out 1-2
  /// neighbors, 2 also 1-3, 3 also 1-4.
  /// @throws InvalidParameter for indices as above or a depth outside 1..3.
  static Exclusions from_bonds(std::size_t n, Span<const IndexPair> bonds, int depth);

  bool empty() const { return partner_.empty(); }
  /// Number of particles, 0 if there are no exclusions.
  std::size_t size() const { return first_.empty() ? 0 : first_.size() - 1; }
  /// Partners of particle i in ascending order.
  Span<const std::int32_t> partners(std::int32_t i) const {
    const auto row = static_cast<std::size_t>(i);
    if (i < 0 || row >= size()) return {};
    return {partner_.data() + first_[row], static_cast<std::size_t>(first_[row + 1] - first_[row])};
  }
  bool excluded(std::int32_t i, std::int32_t j) const;
  /// Number of excluded pairs.
  std::int64_t pairs() const { return static_cast<std::int64_t>(partner_.size()) / 2; }

 private:
  std::vector<std::int64_t> first_;    ///< row i is partner_[first_[i]] .. partner_[first_[i+1]-1]
  std::vector<std::int32_t> partner_;  ///< each pair stored both ways
};

}  // namespace dch
#pragma GCC visibility pop
