// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace dch::cli {

/// Breaks text into lines of at most `width` characters at spaces; a longer word stays whole.
std::string wrap_text(const std::string& text, std::size_t width);

}  // namespace dch::cli
