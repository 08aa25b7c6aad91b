// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <dch/trajectory/frame.hpp>

namespace dch::trajectory {

/// An id that two atoms of a frame share, and their places in the file's order.
struct RepeatedId {
  std::int64_t id;
  std::int64_t first, second;
};

/// Brings the atoms of frames into ascending order of their ids.
class FrameSorter {
 public:
  /// Sorts, or returns the first repeated id and leaves the frame as it is. O(n) if it is sorted, else O(n lg
  /// n).
  std::optional<RepeatedId> sort_by_id(Frame& frame);

 private:
  template <class T>
  void reorder(std::vector<T>& values) const;

  std::vector<std::pair<std::int64_t, std::int32_t>> order_;  ///< (id, place), kept for its memory
};

}  // namespace dch::trajectory
