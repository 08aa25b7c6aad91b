// SPDX-License-Identifier: MIT
#include "files/line_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <dch/trajectory/file_error.hpp>

#include "base/text.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<std::string> lines_of(const std::string& path,
                                  FinalNewline final_newline = FinalNewline::optional) {
  LineReader reader(path, final_newline, ReadLimits());
  std::vector<std::string> lines;
  for (std::string_view line; reader.next(line);) lines.emplace_back(line);
  return lines;
}

TEST(LineReader, SplitsLines) {
  const ScratchFolder folder;
  EXPECT_THAT(lines_of(folder.write("a", "one\n\nthree\r\nfour")), ElementsAre("one", "", "three", "four"));
  EXPECT_THAT(lines_of(folder.write("b", "one\n")), ElementsAre("one"));
}

TEST(LineReader, DemandsTheFinalNewlineIfAsked) {
  const ScratchFolder folder;
  const std::string path = folder.write("a", "one\ntwo");
  EXPECT_THAT([&] { lines_of(path, FinalNewline::required); },
              ThrowsMessage<FileError>(HasSubstr(path + ": line 2: the file ends inside this line")));
  EXPECT_THAT(lines_of(folder.write("b", "one\ntwo\n"), FinalNewline::required), ElementsAre("one", "two"));
}

TEST(LineReader, PutsALineBack) {
  const ScratchFolder folder;
  LineReader reader(folder.write("a", "one\ntwo\n"), FinalNewline::required, ReadLimits());
  std::string_view line;
  ASSERT_TRUE(reader.next(line));
  reader.put_back();
  ASSERT_TRUE(reader.next(line));
  EXPECT_EQ(line, "one");
  EXPECT_EQ(reader.number(), 1);
  ASSERT_TRUE(reader.next(line));
  EXPECT_EQ(line, "two");
}

TEST(LineReader, ReadsLinesAcrossItsBuffer) {
  const ScratchFolder folder;
  const std::string longest(1 << 20, 'x');
  std::string text;
  for (int k = 0; k < 5; ++k) text += longest + "\n" + std::to_string(k) + "\n";
  const auto lines = lines_of(folder.write("a", text));
  ASSERT_EQ(lines.size(), 10u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(lines[2 * k], longest);
    EXPECT_EQ(lines[2 * k + 1], std::to_string(k));
  }
}

TEST(LineReader, RefusesWhatIsNoText) {
  const ScratchFolder folder;
  const std::string path = folder.write("a", "one\n" + std::string(3 << 20, 'x'));
  EXPECT_THAT([&] { lines_of(path); }, ThrowsMessage<FileError>(HasSubstr("line 2: is longer than 1 MiB")));
}

TEST(Text, QuotesUnprintableAndLongWords) {
  EXPECT_EQ(in_quotes("a\tb\x80"), "'a?b?'");
  EXPECT_EQ(in_quotes(std::string(100, 'x')), "'" + std::string(60, 'x') + "...'");
}

}  // namespace
}  // namespace dch::trajectory::test
