// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <string>

#include <dch/base/vec3.hpp>

namespace dch::detail {

/// Numbers in error messages: the shortest text that reads back as the same double.
inline std::string describe(double value) {
  std::array<char, 32> text;
  char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return std::string(text.data(), end);
}

inline std::string describe(Vec3 v) {
  return "(" + describe(v.x) + ", " + describe(v.y) + ", " + describe(v.z) + ")";
}

}  // namespace dch::detail
