// SPDX-License-Identifier: MIT
#include "options/option_values.hpp"

#include <utility>

#include "base/exit_code.hpp"
#include "expect_error.hpp"
#include "temporary_folder.hpp"

namespace dch::cli {
namespace {

std::vector<std::int64_t> frames_of(const std::string& text, std::int64_t file_frames) {
  const FrameRange range = parse_frame_range(text);
  std::vector<std::int64_t> frames;
  for (std::int64_t k = 0; k < file_frames; ++k) {
    if (range.contains(k)) frames.push_back(k);
  }
  return frames;
}

TEST(FrameRange, SelectsAsPythonSlicesDo) {
  using Frames = std::vector<std::int64_t>;
  EXPECT_EQ(frames_of("2:5", 10), (Frames{2, 3, 4}));
  EXPECT_EQ(frames_of("2:9:3", 10), (Frames{2, 5, 8}));
  EXPECT_EQ(frames_of("::4", 10), (Frames{0, 4, 8}));
  EXPECT_EQ(frames_of(":3", 10), (Frames{0, 1, 2}));
  EXPECT_EQ(frames_of("8:", 10), (Frames{8, 9}));
  EXPECT_EQ(frames_of(":", 3), (Frames{0, 1, 2}));
  EXPECT_EQ(frames_of("1::", 3), (Frames{1, 2}));
  EXPECT_EQ(frames_of("7", 10), (Frames{7}));
}

TEST(FrameRange, RefusesWhatIsNoRangeAndNamesIt) {
  for (const std::string text :
       {"", "a:b", "1:2:3:4", "-3:", "1.5:3", "1 :3", "99999999999999999999:", "9223372036854775807"}) {
    expect_error<UsageError>([&] { parse_frame_range(text); }, {"--frames", text, "first:end:step"});
  }
  expect_error<UsageError>([] { parse_frame_range("1:9:0"); }, {"1:9:0", "step is 0"});
}

TEST(FrameRange, RefusesRangesWithoutFrames) {
  expect_error<UsageError>([] { parse_frame_range("5:2"); }, {"5:2", "selects no frame"});
  expect_error<UsageError>([] { parse_frame_range("5:5"); }, {"5:5", "selects no frame"});
  expect_error<UsageError>([] { parse_frame_range("0:0"); }, {"0:0", "selects no frame"});
}

const NumberLimits kAboveZero{0, 1e100, true, "a length"};

TEST(Number, AcceptsWhatLiesWithinItsLimits) {
  EXPECT_EQ(parse_number("--cutoff", "2.5", kAboveZero), 2.5);
  EXPECT_EQ(parse_number("--cutoff", "+1e-3", kAboveZero), 1e-3);
  EXPECT_EQ(parse_number("--skin", "0", {0, 1, false, "a length"}), 0);
  EXPECT_EQ(parse_number("--skin", "1", {0, 1, false, "a length"}), 1);
}

TEST(Number, RefusesOthersAndNamesValueLimitAndMeaning) {
  for (const std::string text : {"", "nan", "inf", "-inf", "abc", "1.5x", " 2", "1e999"}) {
    expect_error<UsageError>([&] { parse_number("--cutoff", text, kAboveZero); },
                             {"--cutoff", "'" + text + "'", "a length"});
  }
  expect_error<UsageError>([] { parse_number("--cutoff", "0", kAboveZero); },
                           {"--cutoff 0", "above 0", "a length"});
  expect_error<UsageError>([] { parse_number("--cutoff", "-3", kAboveZero); }, {"--cutoff -3", "above 0"});
  expect_error<UsageError>([] { parse_number("--cutoff", "1e101", kAboveZero); },
                           {"1e101", "at most 1e+100"});
  expect_error<UsageError>(
      [] {
        parse_number("--c", "1", {1.05, 9, false, "c"});
      },
      {"--c 1", "at least 1.05"});
}

TEST(WholeNumber, AcceptsAndRefuses) {
  EXPECT_EQ(parse_whole_number("--chains", "12", 1, 100, "chains"), 12);
  for (const std::string text : {"", "0", "101", "1.5", "-4", "x", "99999999999999999999"}) {
    expect_error<UsageError>([&] { parse_whole_number("--chains", text, 1, 100, "the chains"); },
                             {"--chains", text, "from 1 to 100", "the chains"});
  }
}

class DistinctFiles : public TemporaryFolder {};

TEST_F(DistinctFiles, RefusesOneFileUnderTwoNames) {
  create(path("in.dcd"), "x");
  std::filesystem::create_symlink(path("in.dcd"), path("link.dcd"));
  const std::string detour =
      path("") + "/../" + std::filesystem::path(path("")).parent_path().filename().string() + "/new";
  expect_error<UsageError>(
      [&] {
        require_distinct_files({{"IN", path("in.dcd")}}, {{"OUT", path("link.dcd")}});
      },
      {"IN and OUT", "same file"});
  expect_error<UsageError>(
      [&] {
        require_distinct_files({}, {{"--report", path("new")}, {"--plot", detour}});
      },
      {"--report and --plot", "same file"});
}

TEST_F(DistinctFiles, RefusesOneFileThatIsNotThereYetUnderTwoNames) {
  std::filesystem::create_symlink("new", path("link"));
  std::filesystem::create_symlink(path("link"), path("chain"));
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(path(""));
  for (const auto& [report, plot] :
       {std::pair("new", "./new"), std::pair("new", "link"), std::pair("./chain", "new")}) {
    expect_error<UsageError>(
        [&] {
          require_distinct_files({}, {{"--report", report}, {"--plot", plot}});
        },
        {"--report and --plot", "same file"});
  }
  EXPECT_NO_THROW(require_distinct_files({}, {{"--report", "new"}, {"--plot", "./newer"}}));
  std::filesystem::current_path(before);
}

TEST_F(DistinctFiles, AcceptsDifferentFilesAndNamesNotGiven) {
  create(path("in.dcd"), "x");
  EXPECT_NO_THROW(
      require_distinct_files({{"FILE", path("in.dcd")}, {"--topology", ""}},
                             {{"--out", ""}, {"--report", path("a")}, {"--plot", path("b")}, {"--x", ""}}));
}

}  // namespace
}  // namespace dch::cli
