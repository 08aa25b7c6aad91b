// SPDX-License-Identifier: MIT
#pragma once

namespace dch::detail {
namespace {

/// By a mask of kLanes lanes of kBytes bytes: the bytes of a register of 128 bits that move the chosen lanes
/// to the front.
template <int kLanes, int kBytes>
struct PackBytes {
  static_assert(kLanes * kBytes == 16);
  alignas(16) unsigned char bytes[1 << kLanes][16]{};
  constexpr PackBytes() {
    for (int mask = 0; mask < 1 << kLanes; ++mask) {
      int to = 0;
      for (int lane = 0; lane < kLanes; ++lane)
        for (int byte = 0; (mask >> lane & 1) != 0 && byte < kBytes; ++byte)
          bytes[mask][to++] = static_cast<unsigned char>(kBytes * lane + byte);
    }
  }
};

}  // namespace
}  // namespace dch::detail
