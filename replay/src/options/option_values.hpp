// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/exit_code.hpp"

namespace dch::cli {

class Command;
class Option;

/// Frames begin, begin + step, ... below end, counted from 0 (as Python slices).
struct FrameRange {
  std::int64_t begin = 0;
  std::int64_t end = std::numeric_limits<std::int64_t>::max();
  std::int64_t step = 1;

  bool contains(std::int64_t frame) const {
    return frame >= begin && frame < end && (frame - begin) % step == 0;
  }
  bool bounded() const { return end != std::numeric_limits<std::int64_t>::max(); }
};

/// Reads "a:b:s", each part optional, or a single frame number.
/// @throws UsageError for anything else, a step below 1 and a range without frames, such as 5:2.
FrameRange parse_frame_range(const std::string& text);

/// A finite number within [lowest, highest]; with `lowest_is_open` the lowest value itself is refused.
struct NumberLimits {
  double lowest = 0;
  double highest = 0;
  bool lowest_is_open = false;
  std::string meaning;  ///< for messages: "the cutoff, a length in the file's unit"
};

/// @throws UsageError naming option, value, limits and meaning.
double parse_number(const std::string& option, const std::string& text, const NumberLimits& limits);

/// A whole number within [lowest, highest].
/// @throws UsageError as parse_number.
std::int64_t parse_whole_number(const std::string& option, const std::string& text, std::int64_t lowest,
                                std::int64_t highest, const std::string& meaning);

/// The number of threads that --threads gives, from 1 to 1,024. @throws UsageError as parse_number.
int parse_threads(const std::string& text);

/// The value of a word that is one of a few.
/// @throws UsageError naming the option, the word and those known.
template <class Value>
Value choose(const std::string& option, const std::string& word,
             const std::vector<std::pair<std::string, Value>>& choices) {
  std::string known;
  for (const auto& [name, value] : choices) {
    if (name == word) return value;
    known += (known.empty() ? "" : ", ") + name;
  }
  throw UsageError(option + " '" + word + "': not known; choose one of " + known);
}

/// A file name that an option gave.
struct NamedPath {
  std::string option;  ///< "--out", "FILE", ...
  std::string path;    ///< empty if not given
};

/// Declares an option or argument that names a file. An empty name, which a variable of a script may have
/// turned out to be, is refused: it would mean that none was given.
Option* add_file_option(Command& command, const std::string& option, std::string& path,
                        const std::string& help);

/// @throws UsageError if two outputs, or an output and an input, are the same file, and for an output "-".
void require_distinct_files(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs);

}  // namespace dch::cli
