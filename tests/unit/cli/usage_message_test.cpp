// SPDX-License-Identifier: MIT
#include "options/usage_message.hpp"

#include <gtest/gtest.h>

namespace dch::cli {
namespace {

TEST(ClosestWord, ForgivesSlipsOfTheFinger) {
  const std::vector<std::string> names{"info", "replay", "contacts", "convert", "generate", "help"};
  EXPECT_EQ(closest_word("repaly", names), "replay") << "swapped";
  EXPECT_EQ(closest_word("replya", names), "replay");
  EXPECT_EQ(closest_word("inf", names), "info") << "cut short";
  EXPECT_EQ(closest_word("gen", names), "generate");
  EXPECT_EQ(closest_word("contact", names), "contacts");
  EXPECT_EQ(closest_word("convrt", names), "convert") << "left out";
  EXPECT_EQ(closest_word("halp", names), "help") << "changed";
  EXPECT_EQ(closest_word("infoo", names), "info") << "added";
}

TEST(ClosestWord, SuggestsNothingFarFetched) {
  const std::vector<std::string> names{"info", "replay", "contacts", "convert", "generate", "help"};
  for (const char* word : {"", "x", "foo", "frobnicate", "hierarchy"})
    EXPECT_EQ(closest_word(word, names), "");
  EXPECT_EQ(closest_word("info", {}), "");
}

}  // namespace
}  // namespace dch::cli
