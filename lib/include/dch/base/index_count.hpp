// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include <dch/base/error.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Most things that 32-bit indices name.
inline constexpr std::int64_t kMaxIndexCount = std::numeric_limits<std::int32_t>::max();

/// @throws InvalidParameter naming the count, the limit and the remedy.
[[noreturn]] inline void refuse_count(std::int64_t count, const char* things, const char* remedy,
                                      std::int64_t most) {
  throw InvalidParameter(std::to_string(count) + " " + things + "; indices are 32-bit, so at most " +
                         std::to_string(most) + " are possible: " + remedy);
}

/// A number of things that 32-bit indices are to name, as such an index. To be asked before the things are
/// made: whatever multiplies or adds up counts does so in 64 bits and asks here.
/// @param most fewer than kMaxIndexCount where each of the things takes several indices
/// @throws InvalidParameter for more than that.
inline std::int32_t index_count(std::int64_t count, const char* things, const char* remedy,
                                std::int64_t most = kMaxIndexCount) {
  if (count > most) refuse_count(count, things, remedy, most);
  return static_cast<std::int32_t>(count);
}

}  // namespace dch
#pragma GCC visibility pop
