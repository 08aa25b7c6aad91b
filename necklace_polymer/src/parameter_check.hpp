// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <dch/error.hpp>

namespace dch::necklace::detail {

/// @throws InvalidParameter with the message unless the condition holds.
inline void require_parameter(bool holds, const std::string& message) {
  if (!holds) throw InvalidParameter(message);
}

}  // namespace dch::necklace::detail
