// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <limits>

#include "base/number_text.hpp"
#include "base/progress_bar.hpp"
#include "options/help_text.hpp"

namespace dch::cli {
namespace {

TEST(NumberText, GroupsThousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(-1234567), "-1,234,567");
  EXPECT_EQ(grouped(-123), "-123");
  EXPECT_EQ(grouped(std::numeric_limits<std::int64_t>::min()), "-9,223,372,036,854,775,808");
}

TEST(NumberText, CountsThings) {
  EXPECT_EQ(counted(1, "frame"), "1 frame");
  EXPECT_EQ(counted(0, "frame"), "0 frames");
  EXPECT_EQ(counted(1200, "frame"), "1,200 frames");
}

TEST(NumberText, KeepsFourDigits) {
  EXPECT_EQ(readable(0), "0");
  EXPECT_EQ(readable(12.3456), "12.35");
  EXPECT_EQ(readable(12345.6), "12,346");
  EXPECT_EQ(readable(1.2346e-7), "1.235e-07");
  EXPECT_EQ(readable(std::numeric_limits<double>::infinity()), "inf");
}

TEST(ProgressText, ShowsABarRateAndTimeLeft) {
  EXPECT_EQ(progress_text("replaying", 0, 10, 0), "replaying [..............................] 0/10");
  EXPECT_EQ(progress_text("replaying", 5, 10, 1),
            "replaying [###############...............] 5/10  200 ms/frame, 1 s left");
  EXPECT_EQ(progress_text("replaying", 10, 10, 2),
            "replaying [##############################] 10/10  200 ms/frame, 0 s left");
}

TEST(ProgressText, CountsFramesWhereTheirNumberIsNotKnown) {
  EXPECT_EQ(progress_text("checking a.xtc", 1234, 0, 1), "checking a.xtc frame 1,234");
}

TEST(WrapText, BreaksLinesAtSpaces) {
  EXPECT_EQ(wrap_text("", 10), "");
  EXPECT_EQ(wrap_text("one two three", 7), "one two\nthree");
  EXPECT_EQ(wrap_text("incomprehensibly long", 7), "incomprehensibly\nlong");
}

}  // namespace
}  // namespace dch::cli
