// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include <dch/base/error.hpp>

namespace dch::detail {

/// @throws InvalidParameter if the numbers of two things that belong to the same particles differ.
inline void require_same_count(std::size_t wanted, const char* of, std::size_t found, const char* what) {
  if (found == wanted) return;
  throw InvalidParameter(std::to_string(found) + " " + what + " given for " + std::to_string(wanted) + " " +
                         of + "; give one for each particle");
}

}  // namespace dch::detail
