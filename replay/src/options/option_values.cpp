// SPDX-License-Identifier: MIT
#include "options/option_values.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/exit_code.hpp"
#include "options/command_line.hpp"

namespace dch::cli {
namespace {

template <class T>
std::optional<T> parse_entire(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

constexpr const char* kRangeHelp =
    "give first:end:step, counted from 0 and the end not included, for example 10:20 or ::5";

std::vector<std::string_view> split_at_colons(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t colon = text.find(':', begin);
    parts.push_back(text.substr(begin, colon - begin));
    if (colon == std::string_view::npos) return parts;
    begin = colon + 1;
  }
}

std::int64_t parse_range_part(const std::string& text, std::string_view part, std::int64_t otherwise) {
  if (part.empty()) return otherwise;
  const auto value = parse_entire<std::int64_t>(part);
  if (!value || *value < 0) {
    throw UsageError(
        fmt::format("--frames {}: '{}' is not a frame number of 0 or more; {}", text, part, kRangeHelp));
  }
  return *value;
}

/// Where a file would be made: at the end of links, whether anything is there yet or not.
std::filesystem::path place_of(const std::string& name, std::error_code& error) {
  constexpr int kMaxLinks = 40;  // as many as the system follows
  std::filesystem::path place = std::filesystem::absolute(name, error);
  for (int k = 0; k < kMaxLinks && !error && std::filesystem::is_symlink(place, error); ++k)
    place = place.parent_path() / std::filesystem::read_symlink(place, error);
  error.clear();  // of what is not there
  return std::filesystem::weakly_canonical(place, error);
}

/// The same file under two names, or two names for a file that does not exist yet.
bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error) && !error) return true;
  const auto place_a = place_of(a, error);
  if (error) return a == b;
  const auto place_b = place_of(b, error);
  return error ? a == b : place_a == place_b;
}

void require_distinct(const NamedPath& a, const NamedPath& b) {
  if (a.path.empty() || b.path.empty() || !same_file(a.path, b.path)) return;
  throw UsageError(fmt::format("{} and {} are the same file, {}; give the output another name", a.option,
                               b.option, b.path));
}

}  // namespace

FrameRange parse_frame_range(const std::string& text) {
  const auto parts = split_at_colons(text);
  if (text.empty() || parts.size() > 3) {
    throw UsageError(fmt::format("--frames '{}': not a range of frames; {}", text, kRangeHelp));
  }
  FrameRange range;
  range.begin = parse_range_part(text, parts[0], range.begin);
  if (parts.size() == 1) {
    if (range.begin == range.end)
      throw UsageError(fmt::format("--frames {}: too large; {}", text, kRangeHelp));
    range.end = range.begin + 1;
    return range;
  }
  range.end = parse_range_part(text, parts[1], range.end);
  if (parts.size() == 3) range.step = parse_range_part(text, parts[2], range.step);
  if (range.step < 1) {
    throw UsageError(fmt::format("--frames {}: the step is 0, but must be 1 or more; {}", text, kRangeHelp));
  }
  if (range.end <= range.begin) {
    throw UsageError(
        fmt::format("--frames {}: selects no frame, since the end, {}, is not beyond the first, {}; {}", text,
                    range.end, range.begin, kRangeHelp));
  }
  return range;
}

double parse_number(const std::string& option, const std::string& text, const NumberLimits& limits) {
  const auto value = parse_entire<double>(text);
  if (!value || !std::isfinite(*value)) {
    throw UsageError(
        fmt::format("{} '{}': not a finite number; give {}, for example 2.5", option, text, limits.meaning));
  }
  const bool too_low = limits.lowest_is_open ? *value <= limits.lowest : *value < limits.lowest;
  if (too_low || *value > limits.highest) {
    throw UsageError(fmt::format("{} {}: must be {} {} and at most {}; give {}", option, text,
                                 limits.lowest_is_open ? "above" : "at least", limits.lowest, limits.highest,
                                 limits.meaning));
  }
  return *value;
}

std::int64_t parse_whole_number(const std::string& option, const std::string& text, std::int64_t lowest,
                                std::int64_t highest, const std::string& meaning) {
  const auto value = parse_entire<std::int64_t>(text);
  if (!value || *value < lowest || *value > highest) {
    throw UsageError(fmt::format("{} '{}': not a whole number from {} to {}; give {}", option, text, lowest,
                                 highest, meaning));
  }
  return *value;
}

int parse_threads(const std::string& text) {
  constexpr std::int64_t kMaxThreads = 1024;
  return static_cast<int>(parse_whole_number("--threads", text, 1, kMaxThreads, "the number of threads"));
}

Option* add_file_option(Command& command, const std::string& option, std::string& path,
                        const std::string& help) {
  return command.add_option(option, path, help)
      ->refuse_empty("the name of the file is empty; give one, or leave the option out");
}

void require_distinct_files(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs) {
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    if (outputs[k].path == "-") {
      throw UsageError(
          fmt::format("{} -: files are not written to standard output; give the name of a file, ./- "
                      "for one of that name",
                      outputs[k].option));
    }
    for (const NamedPath& input : inputs) require_distinct(input, outputs[k]);
    for (std::size_t m = 0; m < k; ++m) require_distinct(outputs[m], outputs[k]);
  }
}

}  // namespace dch::cli
