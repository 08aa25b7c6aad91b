// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace dch::detail {

/// Running estimate of what an operation costs, from its own wall-clock times [s].
///
/// Interruptions only ever add to a time, so the least one seen counts, and may rise by 5 % with each
/// observation to follow a real change.
class CostEstimate {
 public:
  bool known() const { return seconds_ > 0; }
  double seconds() const { return seconds_; }
  void observe(double seconds) {
    seconds_ = known() ? std::min(seconds, 1.05 * seconds_) : std::max(seconds, 1e-12);
  }
  /// An estimate that ruled its operation out is not observed again and might be wrong for good: let it fade,
  /// so that the operation is tried again some time.
  void fade() { seconds_ *= 0.9; }

 private:
  double seconds_ = 0;
};

}  // namespace dch::detail
