// SPDX-License-Identifier: MIT
#include "options/read_options.hpp"

#include <cctype>
#include <charconv>
#include <fmt/format.h>
#include <string_view>

#include "base/exit_code.hpp"
#include "options/command_line.hpp"

namespace dch::cli {

void add_max_expanded(Command& command, std::string& word) {
  command
      .add_option("--max-expanded", word,
                  "What a compressed file may expand to within one frame: bytes, or a number of K, M, G, T. "
                  "Default: 4G")
      ->type_name("SIZE");
}

trajectory::ReadLimits parse_max_expanded(const std::string& word) {
  trajectory::ReadLimits limits;
  if (word.empty()) return limits;
  constexpr std::string_view kUnits = "KMGT";
  constexpr std::int64_t kMin = std::int64_t{1} << 20, kMax = std::int64_t{1} << 50;
  const auto letter = static_cast<char>(std::toupper(static_cast<unsigned char>(word.back())));
  const std::size_t unit = kUnits.find(letter);
  const std::size_t digits = unit == std::string_view::npos ? word.size() : word.size() - 1;
  const int shift = unit == std::string_view::npos ? 0 : 10 * (static_cast<int>(unit) + 1);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + digits, number);
  const bool good =
      error == std::errc() && end == word.data() + digits && number >= 0 && number <= kMax >> shift;
  if (!good || number << shift < kMin) {
    throw UsageError(
        fmt::format("--max-expanded '{}': not a size from 1M to 1024T; give the bytes that a frame "
                    "of a compressed file may expand to, such as 8G",
                    word));
  }
  limits.expanded = number << shift;
  return limits;
}

}  // namespace dch::cli
