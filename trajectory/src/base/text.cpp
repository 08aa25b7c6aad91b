// SPDX-License-Identifier: MIT
#include "base/text.hpp"

namespace dch::trajectory {

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kShown = 60;
  std::string out = "'";
  for (const char c : word.substr(0, kShown)) out += c >= ' ' && c <= '~' ? c : '?';
  if (word.size() > kShown) out += "...";
  return out + "'";
}

}  // namespace dch::trajectory
