// SPDX-License-Identifier: MIT
#include "options/help_text.hpp"

#include <sstream>

namespace dch::cli {

std::string wrap_text(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string wrapped, word;
  std::size_t column = 0;
  while (words >> word) {
    if (column > 0 && column + 1 + word.size() > width) {
      wrapped += '\n';
      column = 0;
    } else if (column > 0) {
      wrapped += ' ';
      ++column;
    }
    wrapped += word;
    column += word.size();
  }
  return wrapped;
}

}  // namespace dch::cli
