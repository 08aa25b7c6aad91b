// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace dch::detail {

/// resize() that takes memory for so many entries at first, and for a sixteenth more when there is not
/// enough: where vectors would take twice as much as before, for a few entries that come now and then.
template <class Vector>
void resize_closely(Vector& array, std::size_t count) {
  if (array.capacity() < count) array.reserve(array.capacity() == 0 ? count : count + count / 16);
  array.resize(count);
}

}  // namespace dch::detail
