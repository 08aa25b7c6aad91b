// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

namespace dch::trajectory {

inline bool separates_words(char c) { return c == ' ' || c == '\t'; }

/// Takes the next word off the front of `rest`; false if there is none. Blanks and tabs separate.
///
/// By plain loops: find_first_of() makes a call for each character.
inline bool next_word(std::string_view& rest, std::string_view& word) {
  const char *begin = rest.data(), *const last = begin + rest.size();
  while (begin != last && separates_words(*begin)) ++begin;
  if (begin == last) return false;
  const char* end = begin;
  while (end != last && !separates_words(*end)) ++end;
  word = {begin, static_cast<std::size_t>(end - begin)};
  rest = {end, static_cast<std::size_t>(last - end)};
  return true;
}

inline bool is_blank(std::string_view line) { return std::all_of(line.begin(), line.end(), separates_words); }

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
