// SPDX-License-Identifier: MIT
#include <csignal>
#include <optional>

#include "output_file_case.hpp"

namespace dch::trajectory::test {
namespace {

extern "C" void remove_and_end(int) {
  remove_unfinished_files();
  ::_exit(0);
}

TEST_F(OutputFileTest, AppearsUnderItsNameOnlyWhenCommitted) {
  OutputFile file(path("report.json"));
  file.write("first, ");
  file.write("second");
  EXPECT_FALSE(fs::exists(path("report.json")));
  EXPECT_EQ(content(file.temporary_path()), "first, second");
  file.commit();
  EXPECT_EQ(content(path("report.json")), "first, second");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, LeavesNothingBehindWithoutCommit) {
  {
    OutputFile file(path("report.json"));
    file.write("text");
    EXPECT_EQ(files(), 1u);
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(OutputFileTest, KeepsAnExistingFileUntilCommitAndThenReplacesIt) {
  const std::string old = create("report.json", "old");
  { OutputFile(old).write("new"); }
  EXPECT_EQ(content(old), "old");
  put(old, "new");
  EXPECT_EQ(content(old), "new");
}

TEST_F(OutputFileTest, TakesAnotherNameIfOneWasLeftBehind) {
  std::string first;
  {
    OutputFile file(path("out"));
    first = file.temporary_path();
  }
  create(fs::path(first).filename().string(), "left by a run of the same number that was killed");
  OutputFile file(path("out"));
  EXPECT_NE(file.temporary_path(), first);
  file.commit();
  EXPECT_EQ(files(), 2u);
}

TEST_F(OutputFileTest, WritesThroughNoLinkUnderItsTemporaryName) {
  std::string first;
  {
    OutputFile file(path("out"));
    first = file.temporary_path();
  }
  const std::string precious = create("precious", "precious");
  for (const std::string& target : {precious, path("nothing")}) {
    fs::create_symlink(target, first);
    put(path("out"), "new");
    EXPECT_TRUE(fs::is_symlink(first));
    fs::remove(first);
  }
  EXPECT_EQ(content(precious), "precious");
  EXPECT_FALSE(fs::exists(path("nothing")));
}

TEST_F(OutputFileTest, TakesNamesAsLongAsTheSystemAllows) {
  const std::string longest(255, 'x');
  put(path(longest), "text");
  EXPECT_EQ(content(path(longest)), "text");
  expect_refused(path(longest + "x"), "File name too long");
}

TEST_F(OutputFileTest, FilesOfOneNameDoNotMeet) {
  OutputFile first(path("out")), second(path("out"));
  first.write("first");
  second.write("second");
  second.commit();
  EXPECT_EQ(content(path("out")), "second");
  first.commit();
  EXPECT_EQ(content(path("out")), "first");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, RemovesUnfinishedFilesFromASignalHandler) {
  const std::string old = create("old", "old");
  EXPECT_EQ(in_a_child([&] {
              std::signal(SIGHUP, remove_and_end);
              OutputFile replaced(old), fresh(path("new"));
              put(path("done"), "done");
              std::optional<OutputFile> given_up(path("given_up"));
              given_up.reset();
              replaced.write("new");
              if (files() != 4) ::_exit(1);
              std::raise(SIGHUP);
              ::_exit(2);
            }),
            0);
  EXPECT_EQ(content(old), "old");
  EXPECT_EQ(content(path("done")), "done");
  EXPECT_EQ(files(), 2u);
}

TEST_F(OutputFileTest, NotesManyFilesOneAfterTheOther) {
  for (int k = 0; k < 200; ++k) put(path("out"), "text");
  OutputFile file(path("out"));
  file.write("last");
  remove_unfinished_files();
  EXPECT_EQ(files(), 1u);
  EXPECT_THAT([&] { file.commit(); }, ThrowsMessage<FileError>(HasSubstr("cannot be given its name")));
  EXPECT_EQ(content(path("out")), "text");
}

}  // namespace
}  // namespace dch::trajectory::test
