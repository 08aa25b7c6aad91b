// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace dch::trajectory {

/// The last part of a path, in lower case.
std::string lower_case_name(const std::string& path);

/// True if the name is longer than the ending and ends in it.
bool has_ending(std::string_view name, std::string_view ending);

}  // namespace dch::trajectory
