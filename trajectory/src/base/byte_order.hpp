// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>

namespace dch::trajectory {

/// A number of type T from its bytes in a file of the given byte order.
template <class T>
T decode(const void* bytes, std::endian order) {
  std::array<unsigned char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (order != std::endian::native) {
    for (std::size_t k = 0; k < sizeof(T) / 2; ++k) std::swap(raw[k], raw[sizeof(T) - 1 - k]);
  }
  return std::bit_cast<T>(raw);
}

}  // namespace dch::trajectory
