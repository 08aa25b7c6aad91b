// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace dch::detail {

/// How far points moved, counted by squared distance in steps of a quarter of an octave.
class Displacements {
 public:
  void add(double square) {
    ++counts_[bucket_of(square)];
    ++size_;
  }
  std::size_t size() const { return size_; }

  /// A squared distance that at most so many points reach, up to a fifth above the least one [length^2].
  double reached_by(std::size_t points) const {
    std::size_t above = 0, bucket = counts_.size();
    while (bucket > 0 && above + counts_[bucket - 1] <= points) above += counts_[--bucket];
    return start_of(bucket);
  }

  /// From which squared displacement on a point asks for itself; 0 if all that have moved do. The others lose
  /// twice the motion that is left, and rounding, of the distances that they know.
  /// @param points how many there are
  /// @param closest2 squared distance of the closest pair before
  double jump2(std::size_t points, double rounding, double closest2) const {
    if (size() * kShareOfJumps < points) return 0;
    const double least2 = std::min(reached_by(0), kJump * kJump * reached_by(size() / kShareOfJumps));
    const double shrinks = 2 * std::sqrt(least2) + 4 * rounding;
    return size() > points / 4 || shrinks * shrinks < closest2 ? least2 : 0;
  }

 private:
  /// Points jump that move this many times as far as all but a share of those that move.
  static constexpr double kJump = 1.5;
  static constexpr std::size_t kShareOfJumps = 64;

  // Of the bits of a double: the exponent and two of the fraction. Squares have no sign.
  static constexpr int kBits = 13, kShift = 63 - kBits;

  static std::size_t bucket_of(double square) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &square, sizeof bits);
    return static_cast<std::size_t>(bits >> kShift);
  }
  /// No square in the buckets below is as large.
  static double start_of(std::size_t bucket) {
    const std::uint64_t bits = static_cast<std::uint64_t>(bucket) << kShift;
    double square = 0;
    std::memcpy(&square, &bits, sizeof square);
    return square;
  }

  std::array<std::uint32_t, std::size_t{1} << kBits> counts_{};  ///< by bucket
  std::size_t size_ = 0;
};

}  // namespace dch::detail
