// SPDX-License-Identifier: GPL-2.0-or-later
#include "table_file.h"

#include <gtest/gtest.h>
#include <sstream>

namespace dch::lammps {
namespace {

double first(const std::string& text, const std::string& keyword = "KEY") {
  std::istringstream file(text);
  return first_distance(file, keyword);
}

TEST(TableFile, BeginsWhereItsSectionSays) {
  EXPECT_EQ(first("KEY\nN 3 R 0.25 2.5\n\n1 0.3 1 1\n"), 0.25);
  EXPECT_EQ(first("# DATE: today\n\nKEY # mine\nRSQ 0.5 2.5 N 3 FPRIME 1 2\n\n1 0.3 1 1\n"), 0.5);
  EXPECT_EQ(first("KEY\nN 2\n\n1 0.3 1 1\n2 0.4 1 1\n"), 0.3);
  EXPECT_EQ(first("KEY\nN 2\n\n# r, e, f\n\n 1\t3.0e-1 1 1\n"), 0.3);
}

TEST(TableFile, KeywordsAreWholeFirstWords) {
  const std::string file =
      "KEYS\nN 2 R 0.1 1\n\n1 0.1 0 0\n2 1 0 0\n\nKEY\nN 2 R 0.2 1\n\n1 0.2 0 0\n2 1 0 0\n\nKEY\nN 2 R 0.3 "
      "1\n";
  EXPECT_EQ(first(file), 0.2);
  EXPECT_EQ(first(file, "KEYS"), 0.1);
  EXPECT_EQ(first(file, "EY"), 0);
}

TEST(TableFile, WhatIsNotUnderstoodIsZero) {
  for (const char* text :
       {"", "KEY", "KEY\nN 2", "KEY\nN 2\n\n1", "KEY\nN 2 R x 1\n", "KEY\nN 2\n\n1 0.3x 0 0\n",
        "KEY\nN 2 RSQ -1 1\n", "KEY\nN 2 R nan 1\n", "KEY\nN 2 BITMAP 0.4\n\n1\n"})
    EXPECT_EQ(first(text), 0) << text;
}

}  // namespace
}  // namespace dch::lammps
