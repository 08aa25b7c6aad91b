// SPDX-License-Identifier: MIT
#pragma once

namespace dch::faults {

/// What fails once memory has run out.
enum class Shortage {
  once,    ///< one allocation
  lasting  ///< all from that one on
};

/// While this lives, the k-th allocation (from 0) of the program fails, whichever thread makes it, by
/// whichever form of operator new. One may live at a time.
class FailingMemory {
 public:
  FailingMemory(long k, Shortage shortage);
  ~FailingMemory();
  FailingMemory(const FailingMemory&) = delete;
  FailingMemory& operator=(const FailingMemory&) = delete;
  /// Whether an allocation has failed.
  bool has_failed() const;
};

}  // namespace dch::faults
