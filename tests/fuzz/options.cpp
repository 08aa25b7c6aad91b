// SPDX-License-Identifier: MIT
//
// Values of options: any words give values within their limits, or a UsageError.
#include <cmath>

#include "fuzz_input.hpp"
#include "options/option_values.hpp"

namespace dch::fuzz {
namespace {

void check_range(const std::string& text) {
  const cli::FrameRange range = cli::parse_frame_range(text);
  if (range.begin < 0 || range.step < 1 || range.end <= range.begin) fail("a range without frames: " + text);
  if (!range.contains(range.begin)) fail("a range without its first frame: " + text);
}

void check_number(FuzzInput& input) {
  cli::NumberLimits limits;
  limits.lowest = input.uniform(-100, 100);
  limits.highest = limits.lowest + input.uniform(0, 100);
  limits.lowest_is_open = input.coin();
  const double value = cli::parse_number("--number", input.rest(), limits);
  if (!std::isfinite(value) || value < limits.lowest || value > limits.highest ||
      (limits.lowest_is_open && value == limits.lowest))
    fail("a number beyond its limits");
}

void check_whole_number(FuzzInput& input) {
  const auto lowest = static_cast<std::int64_t>(input.below(65536)) - 32768;
  const auto highest = lowest + static_cast<std::int64_t>(input.below(65536));
  const std::int64_t value = cli::parse_whole_number("--count", input.rest(), lowest, highest, "a count");
  if (value < lowest || value > highest) fail("a whole number beyond its limits");
}

}  // namespace
}  // namespace dch::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) try {
  dch::fuzz::FuzzInput input(data, size);
  switch (input.below(3)) {
    case 0:
      dch::fuzz::check_range(input.rest());
      break;
    case 1:
      dch::fuzz::check_number(input);
      break;
    default:
      dch::fuzz::check_whole_number(input);
  }
  return 0;
} catch (const dch::cli::UsageError&) {
  return 0;  // an answer to any other words
}
