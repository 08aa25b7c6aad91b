// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace dch::detail {

/// The nearest point that has been seen within a limit; of points equally near, the one with the smallest id.
class ClosestCandidate {
 public:
  /// @param limit2 points at this squared distance are taken yet [length^2]
  void clear(double limit2) {
    distance2_ = limit2;
    id_ = -1;
  }
  void add(double distance2, std::int32_t id) {
    if (distance2 > distance2_ || (distance2 == distance2_ && id_ >= 0 && id > id_)) return;
    distance2_ = distance2;
    id_ = id;
  }
  double limit2() const { return distance2_; }
  /// -1 for none.
  std::int32_t id() const { return id_; }

 private:
  double distance2_ = 0;
  std::int32_t id_ = -1;
};

}  // namespace dch::detail
