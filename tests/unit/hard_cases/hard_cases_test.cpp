// SPDX-License-Identifier: MIT
//
// The table of hard cases, each a test of its own. benchmarks/hard prints the same table at full size.
#include <cctype>
#include <gtest/gtest.h>
#include <stdexcept>

#include "effort.hpp"
#include "hard_case.hpp"
#include "long_double_pairs.hpp"

namespace dch::hard {

void PrintTo(const Case& one, std::ostream* out) { *out << one.area << ": " << one.name; }

namespace {

Effort small() {
  Effort effort;
  effort.repairs = dch::effort(10000);
  effort.most_beads = 4096;
  return effort;
}

std::string id_of(const ::testing::TestParamInfo<Case>& info) {
  std::string id;
  for (const char c : info.param.area + " " + info.param.name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      id += c;
    else if (id.back() != '_')
      id += '_';
    if (c == '+') id += "plus_";
  }
  return id;
}

class HardCase : public ::testing::TestWithParam<Case> {};

TEST_P(HardCase, ComesOutAsExpected) {
  const Finding finding = outcome(GetParam());
  EXPECT_TRUE(finding.passed) << "expected: " << GetParam().expected << "\nfound: " << finding.found;
}

// A comparison that cannot fail is worthless.
TEST(LongDoublePairs, FindsWhatIsMissingAndWhatIsTooMuch) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {4.5, 0, 0}, {2.5, 0, 0}};
  const Box box = Box::orthorhombic({5, 5, 5});
  NeighborList list;
  list.j = {1, 2};  // 0-1, and 0-2 through the face
  list.first = {0, 2, 2, 2, 2};
  const PairComparison right = compare_pairs(list, points, box, 1.2);
  EXPECT_EQ(right.text(), "2 pairs, 0 missing, 0 too many");
  EXPECT_TRUE(right.is_right());
  list.j = {1, 3};
  const PairComparison wrong = compare_pairs(list, points, box, 1.2);
  EXPECT_EQ(wrong.text(), "2 pairs, 1 missing, 1 too many");
  EXPECT_FALSE(wrong.is_right());
  EXPECT_EQ(compare_pairs(list, points, box, 1).in_doubt, 1) << "0-1 is exactly at the radius";
}

TEST(Outcome, AnExceptionIsAFindingThatDidNotPass) {
  const Finding finding = outcome({"", "", "", []() -> Finding { throw std::runtime_error("why"); }});
  EXPECT_FALSE(finding.passed);
  EXPECT_EQ(finding.found, "thrown: why");
}

INSTANTIATE_TEST_SUITE_P(Table, HardCase, ::testing::ValuesIn(all_cases(small())), id_of);

}  // namespace
}  // namespace dch::hard
