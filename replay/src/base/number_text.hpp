// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace dch::cli {

/// A whole number with separators of thousands: 1,234,567.
std::string grouped(std::int64_t value);

/// A number of things: 1 frame, 1,234 frames.
std::string counted(std::int64_t number, const std::string& thing);

/// "854", or "854 to 856" if the two differ.
std::string count_text(std::int64_t fewest, std::int64_t most);

/// About four significant digits for a person to read: 12,346  1,235  12.35  0.01235  1.235e-07.
std::string readable(double value);

}  // namespace dch::cli
