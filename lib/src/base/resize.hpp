// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace dch::detail {

/// resize() that takes memory for so many entries at first, and for a sixteenth more when there is not
/// enough: where vectors would take twice as much as before, for a few entries that come now and then.
template <class Vector>
void resize_closely(Vector& array, std::size_t count) {
  if (array.capacity() < count) array.reserve(array.capacity() == 0 ? count : count + count / 16);
  array.resize(count);
}

/// How much of some work is done.
struct Progress {
  std::int32_t done = 0, all = 0;
};

/// As make_room_for() has it, for an array that is too short. Not in loops that have room most of the time.
template <class Vector>
[[gnu::noinline]] void make_more_room_for(Vector& array, std::size_t wanted, std::size_t filled,
                                          Progress progress) {
  constexpr double kMore = 1.03;
  constexpr std::int32_t kFewest = 64;  ///< steps that tell, and the part of all
  wanted += wanted / 16;
  if (array.capacity() < wanted) {
    const bool can_tell = progress.done >= std::max(kFewest, progress.all / kFewest);
    const double whole = can_tell ? kMore * static_cast<double>(filled) * progress.all / progress.done
                                  : 2 * static_cast<double>(array.size());
    array.reserve(std::max(wanted, static_cast<std::size_t>(whole)));
  }
  array.resize(wanted);
}

/// Makes an array that is being filled at least `wanted` long. What it will hold in the end is reserved as
/// soon as the first part tells, so that it is not copied; it is written to, and so taken from the system,
/// only as far as it is filled. Until then, twice as much as before.
/// @param filled entries by now, which grow with the progress
template <class Vector>
void make_room_for(Vector& array, std::size_t wanted, std::size_t filled, Progress progress) {
  if (array.size() < wanted) make_more_room_for(array, wanted, filled, progress);
}

}  // namespace dch::detail
