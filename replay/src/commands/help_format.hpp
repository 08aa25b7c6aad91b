// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

namespace CLI {
class Formatter;
}

namespace dch::cli {

/// Breaks text into lines of at most `width` characters at spaces; a longer word stays whole.
std::string wrap_text(const std::string& text, std::size_t width);

/// Help texts that fit a terminal of 100 columns.
std::shared_ptr<CLI::Formatter> help_format();

}  // namespace dch::cli
