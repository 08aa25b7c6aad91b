// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace dch::cli {

/// A contact between two successive frames that neither of them shows, or that only one of them shows. Atoms
/// by their ids in the file, times as fractions of the time between the frames.
struct BetweenContact {
  std::int64_t i = -1, j = -1;    ///< i < j
  double enters = 0, leaves = 1;  ///< 0 and 1 where the frame there shows it
  double closest = 0;             ///< least distance [length]
  bool is_hidden = false;         ///< no frame shows it
};

}  // namespace dch::cli
