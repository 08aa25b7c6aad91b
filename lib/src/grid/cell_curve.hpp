// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace dch::detail {

/// Where the pieces of a cell stand along a Hilbert curve through it, so that points that follow each other
/// are close together: a cell halved `halvings` times along each direction has 8^halvings of them.
class CellCurve {
 public:
  /// Coordinates of the finest pieces, whatever the number of halvings, have this many bits.
  static constexpr int kBits = 2;

  constexpr explicit CellCurve(int halvings) : halvings_(halvings) {
    for (std::uint32_t k = 0; k < place_.size(); ++k) {
      const int drop = kBits - halvings;
      place_[k] = static_cast<std::uint8_t>(place_along(
          {(k & kMask) >> drop, (k >> kBits & kMask) >> drop, (k >> (2 * kBits)) >> drop}, halvings));
    }
  }
  constexpr int halvings() const { return halvings_; }
  /// The number of pieces is 2 to this.
  constexpr int bits() const { return 3 * halvings_; }
  /// Place of the piece that holds one of the finest pieces, of whose coordinates the lowest bits count.
  constexpr std::int32_t operator()(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return place_[(static_cast<std::uint32_t>(x) & kMask) | (static_cast<std::uint32_t>(y) & kMask) << kBits |
                  (static_cast<std::uint32_t>(z) & kMask) << (2 * kBits)];
  }

 private:
  static constexpr std::uint32_t kMask = (1u << kBits) - 1;

  /// An octant's place among the eight is that of its bits in a Gray code; within it the axes are exchanged
  /// and reversed so that the curve goes on where it left the octant before (the rules of J. Skilling, AIP
  /// Conf. Proc. 707:381, 2004).
  static constexpr std::uint32_t place_along(std::array<std::uint32_t, 3> at, int bits) {
    std::uint32_t place = 0, turned = 0;
    for (int bit = bits - 1; bit >= 0; --bit) {
      const std::uint32_t below = (1u << bit) - 1;
      std::uint32_t octant = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t is_upper = at[axis] >> bit & 1u;
        octant = octant << 1 | ((octant & 1u) ^ is_upper);
        if (is_upper != 0) {
          at[0] ^= below;
        } else {
          const std::uint32_t differing = (at[0] ^ at[axis]) & below;
          at[0] ^= differing;
          at[axis] ^= differing;
        }
      }
      const std::uint32_t flipped = (turned & 1u) != 0 ? octant ^ 7u : octant;
      place = place << 3 | flipped;
      turned = flipped;
    }
    return place;
  }

  int halvings_;
  std::array<std::uint8_t, 1 << (3 * kBits)> place_{};
};

}  // namespace dch::detail
