// SPDX-License-Identifier: MIT
#include "output_file.hpp"

#include <dch/trajectory/file_error.hpp>

#include "expect_error.hpp"
#include "temporary_folder.hpp"

namespace dch::cli {
namespace {

class OutputFileTest : public TemporaryFolder {};
using trajectory::FileError;

TEST_F(OutputFileTest, AppearsUnderItsNameOnlyWhenCommitted) {
  OutputFile file(path("report.json"));
  file.write("first");
  file.write("text");
  EXPECT_FALSE(std::filesystem::exists(path("report.json")));
  file.commit();
  EXPECT_EQ(content(path("report.json")), "text");
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
  create(path("report.json"), "old");
  { OutputFile(path("report.json")).write("new"); }
  EXPECT_EQ(content(path("report.json")), "old");
  OutputFile file(path("report.json"));
  file.write("new");
  file.commit();
  EXPECT_EQ(content(path("report.json")), "new");
}

TEST_F(OutputFileTest, WritesThroughASymbolicLink) {
  create(path("target"), "old");
  std::filesystem::create_symlink(path("target"), path("link"));
  OutputFile file(path("link"));
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(content(path("target")), "new");
}

TEST_F(OutputFileTest, RefusesAtOnceWhatCannotBeWritten) {
  expect_error<FileError>([&] { OutputFile(path("no/such/folder.json")); },
                          {"no/such/folder.json", "No such file"});
  expect_error<FileError>([&] { OutputFile(path("")); }, {"a folder"});
  expect_error<FileError>([] { OutputFile("/dev/null"); }, {"/dev/null", "not a regular file"});
}

}  // namespace
}  // namespace dch::cli
