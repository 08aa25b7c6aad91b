// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <dch/base/error.hpp>

namespace dch::necklace::detail {

/// The message is made whether it is needed or not, which is too slow for each of many beads.
/// @throws InvalidParameter with the message unless the condition holds.
inline void require_parameter(bool holds, const std::string& message) {
  if (!holds) throw InvalidParameter(message);
}

}  // namespace dch::necklace::detail
