// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace dch::trajectory {

/// Takes the next word off the front of `rest`; false if there is none. Blanks and tabs separate.
inline bool next_word(std::string_view& rest, std::string_view& word) {
  const std::size_t begin = rest.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return false;
  rest.remove_prefix(begin);
  const std::size_t end = rest.find_first_of(" \t");
  word = rest.substr(0, end);
  rest.remove_prefix(word.size());
  return true;
}

inline bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t") == std::string_view::npos;
}

/// Reads a number that fills the whole word; false if it does not or is out of range. Independent of the
/// locale.
template <class T>
bool parse_number(std::string_view word, T& value) {
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && stop == end;
}

/// A word in quotes for a message, shortened, with unprintable bytes replaced.
std::string in_quotes(std::string_view word);

}  // namespace dch::trajectory
