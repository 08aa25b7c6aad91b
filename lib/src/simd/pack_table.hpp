// SPDX-License-Identifier: MIT
#pragma once

namespace dch::detail {
namespace {

/// By a mask of 8 lanes: the chosen lanes, first come first.
struct PackTable {
  alignas(32) unsigned char lanes[256][8]{};
  constexpr PackTable() {
    for (int mask = 0; mask < 256; ++mask) {
      int to = 0;
      for (int lane = 0; lane < 8; ++lane)
        if ((mask >> lane & 1) != 0) lanes[mask][to++] = static_cast<unsigned char>(lane);
    }
  }
};
inline constexpr PackTable kPack;

}  // namespace
}  // namespace dch::detail
