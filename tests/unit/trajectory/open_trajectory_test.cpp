// SPDX-License-Identifier: MIT
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "reading.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::vector<std::string> kEndings{".lammpstrj", ".dump", ".lammpstrj.gz", ".dump.gz", ".xtc",
                                        ".trr",       ".gro",  ".dcd",          ".h5",      ".h5md"};

TEST(OpenTrajectory, RefusesFilesThatCannotBeRead) {
  const ScratchFolder folder;
  for (const std::string& ending : kEndings) {
    const std::string path = folder.path("test" + ending);
    EXPECT_THAT(try_to_read(path).error, AllOf(HasSubstr(path), HasSubstr("No such file"))) << ending;
    folder.write("test" + ending, "");
    EXPECT_THAT(try_to_read(path).error, AllOf(HasSubstr(path), HasSubstr("is empty"))) << ending;
    std::filesystem::remove(path);
    std::filesystem::create_directory(path);
    EXPECT_THAT(try_to_read(path).error, AllOf(HasSubstr(path), HasSubstr("is a folder"))) << ending;
    std::filesystem::remove(path);
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    EXPECT_THAT(try_to_read(path).error, AllOf(HasSubstr(path), HasSubstr("not a regular file"))) << ending;
  }
}

TEST(OpenTrajectory, RefusesContentThatIsNotWhatTheEndingSays) {
  const ScratchFolder folder;
  for (const std::string& ending : kEndings) {
    const std::string path = folder.write("test" + ending, std::string(3000, 'x') + "\n");
    EXPECT_THAT(try_to_read(path).error, HasSubstr(path)) << ending;
  }
}

TEST(OpenTrajectory, ListsTheEndingsItKnows) {
  for (const char* name : {"test.pdb", "test", ".dcd", "dcd"}) {
    const std::string error = try_to_read(name).error;
    EXPECT_THAT(error, HasSubstr("unknown kind of trajectory")) << name;
    for (const std::string& ending : kEndings) EXPECT_THAT(error, HasSubstr(" " + ending));
  }
}

TEST(OpenTrajectory, TakesEndingsInUpperCase) {
  const ScratchFolder folder;
  EXPECT_EQ(read_all(folder.write("TEST.DCD", read_file(data_path("nopbc.dcd")))).size(), 40u);
  EXPECT_EQ(read_all(folder.write("TEST.XTC", read_file(data_path("cell_shapes.xtc")))).size(), 3u);
}

}  // namespace
}  // namespace dch::trajectory::test
