// SPDX-License-Identifier: MIT
// Where an output file may go, and what becomes of what was there.
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>

#include "output_file_case.hpp"

namespace dch::trajectory::test {
namespace {

TEST_F(OutputFileTest, FollowsChainsOfSymbolicLinksAndKeepsThem) {
  fs::create_directory(path("sub"));
  create("sub/target", "old");
  fs::create_symlink("sub/second", path("first"));
  fs::create_symlink("target", path("sub/second"));
  put(path("first"), "new");
  EXPECT_TRUE(fs::is_symlink(path("first")) && fs::is_symlink(path("sub/second")));
  EXPECT_EQ(content(path("sub/target")), "new");
}

TEST_F(OutputFileTest, MakesTheFileThatALinkNamesInVain) {
  fs::create_directory(path("sub"));
  fs::create_symlink(path("sub/target"), path("link"));
  {
    OutputFile file(path("link"));
    EXPECT_EQ(fs::path(file.temporary_path()).parent_path(), path("sub"));
    file.commit();
  }
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_TRUE(fs::is_regular_file(path("sub/target")) && !fs::is_symlink(path("sub/target")));
}

TEST_F(OutputFileTest, RefusesLinksThatLeadInACircle) {
  fs::create_symlink("b", path("a"));
  fs::create_symlink("a", path("b"));
  expect_refused(path("a"), "Too many levels of symbolic links");
}

TEST_F(OutputFileTest, RefusesWhatIsNoFile) {
  fs::create_directory(path("folder"));
  expect_refused(path("folder"), "a folder");
  expect_refused(path("new/"), "a folder");
  expect_refused(path("no/such/folder.json"), "No such file");
  expect_refused("/dev/null", "a device");
  fs::create_symlink("/dev/null", path("link"));
  expect_refused(path("link"), "a device");
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  expect_refused(path("pipe"), "a pipe");
  expect_refused("-", "standard output is no file");
  EXPECT_FALSE(fs::exists(path("new")));
}

TEST_F(OutputFileTest, RefusesSockets) {
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path("socket").copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  expect_refused(path("socket"), "a socket");
  ::close(socket);
}

TEST_F(OutputFileTest, RefusesTheFileThatStandardOutputGoesTo) {
  const std::string log = create("log", "");
  const int before = ::dup(STDOUT_FILENO);
  const int stream = ::open(log.c_str(), O_WRONLY | O_CLOEXEC);
  std::fflush(stdout);
  ASSERT_EQ(::dup2(stream, STDOUT_FILENO), STDOUT_FILENO);
  expect_refused(log, "what is printed goes there");
  expect_refused("/dev/stdout", "what is printed goes there");
  fs::remove(log);
  expect_refused("/dev/stdout", "no name any more");
  ::dup2(before, STDOUT_FILENO);
  ::close(before);
  ::close(stream);
}

TEST_F(OutputFileTest, RefusesAtTheEndWhatIsNoFileAnyMore) {
  OutputFile file(path("report.json"));
  ASSERT_EQ(::mkfifo(path("report.json").c_str(), 0600), 0);
  EXPECT_THAT([&] { file.commit(); },
              ThrowsMessage<FileError>(HasSubstr("a pipe has got its name meanwhile")));
  EXPECT_EQ(status_of(path("report.json")).st_mode & S_IFMT, mode_t{S_IFIFO});
}

TEST_F(OutputFileTest, HandsPermissionsOn) {
  const mode_t umask = ::umask(022);
  put(path("new"), "");
  EXPECT_EQ(mode_of(path("new")), mode_t{0644});
  for (const mode_t mode : {0600, 0640, 0666, 0755}) {
    const std::string old = create("old", "old");
    ASSERT_EQ(::chmod(old.c_str(), mode), 0);
    OutputFile file(old);
    EXPECT_EQ(mode_of(file.temporary_path()), mode_t{0600}) << "nobody else may look into it meanwhile";
    file.commit();
    EXPECT_EQ(mode_of(old), mode);
  }
  ::umask(umask);
}

TEST_F(OutputFileTest, HandsTheOwnerOnIfTheSystemAllowsIt) {
  const std::string old = create("old", "old");
  const bool may_give = ::chown(old.c_str(), 65534, 65533) == 0;
  put(old, "new");
  EXPECT_EQ(status_of(old).st_uid, may_give ? 65534 : ::geteuid());
  EXPECT_EQ(status_of(old).st_gid, may_give ? 65533 : ::getegid());
}

TEST_F(OutputFileTest, DoesNotOpenToOneGroupWhatWasForAnother) {
  if (::geteuid() != 0) return;  // only the superuser makes a file of a group that a user is not in
  fs::permissions(path(""), fs::perms::all);
  const std::string old = create("old", "old");
  ASSERT_EQ(::chown(old.c_str(), 65534, 0), 0);
  ASSERT_EQ(::chmod(old.c_str(), 0664), 0);
  EXPECT_TRUE(as_another_user([&] {
    put(old, "new");
    return true;
  }));
  EXPECT_EQ(content(old), "new");
  EXPECT_EQ(mode_of(old), mode_t{0644});
}

TEST_F(OutputFileTest, LeavesOtherNamesOfTheFileTheirContent) {
  const std::string old = create("old", "old");
  fs::create_hard_link(old, path("other"));
  put(old, "new");
  EXPECT_EQ(content(path("other")), "old");
  EXPECT_EQ(content(old), "new");
}

TEST_F(OutputFileTest, NamesTheReasonWhereThePermissionsForbidIt) {
  const std::string old = create("sub", "");
  fs::remove(old);
  fs::create_directory(path("sub"));
  create("sub/old", "old");
  const auto refuses = [&](const std::string& file) {
    return as_another_user([&] {
      try {
        OutputFile output(file);
      } catch (const FileError& error) {
        return std::string(error.what()).find(file + ": cannot be written") == 0 &&
               std::string(error.what()).find("Permission denied") != std::string::npos;
      }
      return false;
    });
  };
  fs::permissions(path(""), fs::perms::others_all | fs::perms::owner_all);
  fs::permissions(path("sub"), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                   fs::perms::others_exec);
  fs::permissions(path("sub/old"), fs::perms::others_all | fs::perms::owner_all);
  EXPECT_TRUE(refuses(path("sub/new"))) << "a folder that may not be written to";
  EXPECT_TRUE(refuses(path("sub/old"))) << "and a file in it that may";
  fs::permissions(path("sub"), fs::perms::all);
  fs::permissions(path("sub/old"), fs::perms::owner_read | fs::perms::others_read);
  EXPECT_TRUE(refuses(path("sub/old"))) << "a file that may not be written to";
  EXPECT_EQ(content(path("sub/old")), "old");
}

}  // namespace
}  // namespace dch::trajectory::test
