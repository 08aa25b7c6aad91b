// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace dch::necklace::detail {

/// The cell of a grid of side 2^bits that a Hilbert curve visits as the index-th (J. Skilling, AIP Conf.
/// Proc. 707:381, 2004): the index's bits are dealt out to the axes, Gray decoded, and the turns of each
/// level undone from the finest up.
inline std::array<std::uint32_t, 3> hilbert_cell(std::uint32_t index, int bits) {
  std::array<std::uint32_t, 3> cell{};
  for (int bit = 0; bit < 3 * bits; ++bit) {
    const std::uint32_t value = index >> (3 * bits - 1 - bit) & 1;
    auto& axis = cell[static_cast<std::size_t>(bit % 3)];
    axis = axis << 1 | value;
  }
  const std::uint32_t gray = cell[2] >> 1;
  cell[2] ^= cell[1];
  cell[1] ^= cell[0];
  cell[0] ^= gray;
  for (std::uint32_t side = 2; side != 1U << bits; side <<= 1) {
    const std::uint32_t low = side - 1;
    for (std::size_t axis = 3; axis-- > 0;) {
      if (cell[axis] & side) {
        cell[0] ^= low;
      } else {
        const std::uint32_t swap = (cell[0] ^ cell[axis]) & low;
        cell[0] ^= swap;
        cell[axis] ^= swap;
      }
    }
  }
  return cell;
}

}  // namespace dch::necklace::detail
