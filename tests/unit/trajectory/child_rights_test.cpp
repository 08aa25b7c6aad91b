// SPDX-License-Identifier: MIT
// A child process that has given up its rights can read what it has open, and nothing else.
#include "process/child_rights.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "process/child_process.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

struct Attempts {
  int open, create, socket, fork, exec, kill, code, unlink, other_descriptor,
      memory;                                ///< errno; 0: it worked
  int filter, own_descriptor, small_memory;  ///< 1: it worked
};

int error_of(long result) { return result < 0 ? errno : 0; }

Attempts attempt(const ChildRights& rights, const char* path, int other) {
  Attempts a{};
  const char* name = path;
  char* const arguments[] = {const_cast<char*>("/bin/true"), nullptr};
  a.filter = give_up_rights(rights) ? 1 : 0;
  a.open = error_of(::open(name, O_RDONLY));
  a.create = error_of(::open((std::string(name) + ".new").c_str(), O_WRONLY | O_CREAT, 0600));
  a.socket = error_of(::socket(AF_INET, SOCK_STREAM, 0));
  a.fork = error_of(::syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0));
  a.exec = error_of(::execve("/bin/true", arguments, nullptr));
  a.kill = error_of(::kill(::getppid(), 0));
  void* code = ::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  a.code = code == MAP_FAILED ? errno : 0;
  a.unlink = error_of(::unlink(name));
  char byte = 0;
  a.other_descriptor = error_of(::pread(other, &byte, 1, 0));
  a.own_descriptor = ::pread(rights.descriptors.front(), &byte, 1, 0) == 1 && byte == 'x' ? 1 : 0;
  void* much =
      ::mmap(nullptr, std::size_t{1} << 31, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  a.memory = much == MAP_FAILED ? errno : 0;
  void* little = ::mmap(nullptr, 1 << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  a.small_memory = little != MAP_FAILED ? 1 : 0;
  return a;
}

TEST(ChildRights, AreGivenUpForGood) {
  const ScratchFolder folder;
  const std::string path = folder.write("file", "x");
  const int own = ::open(path.c_str(), O_RDONLY), other = ::open(path.c_str(), O_RDONLY);
  ASSERT_GE(own, 0);
  ASSERT_GE(other, 0);
  ChildProcess child([&](int socket) {
    const Attempts a = attempt({{own, socket}, std::int64_t{1} << 30}, path.c_str(), other);
    if (::send(socket, &a, sizeof a, 0) < 0) std::abort();
  });
  Attempts a{};
  ASSERT_EQ(::recv(child.socket(), &a, sizeof a, MSG_WAITALL), static_cast<ssize_t>(sizeof a))
      << child.wait_and_describe();
  ::close(own);
  ::close(other);
  ASSERT_EQ(a.filter, 1) << "the kernel has no seccomp: the readers of HDF5 have limits alone here";
  for (const int refused : {a.open, a.create, a.socket, a.fork, a.exec, a.kill, a.code, a.unlink}) {
    EXPECT_EQ(refused, EPERM);
  }
  EXPECT_EQ(a.other_descriptor, EBADF);
  EXPECT_EQ(a.memory, ENOMEM);
  EXPECT_EQ(a.own_descriptor, 1);
  EXPECT_EQ(a.small_memory, 1);
  EXPECT_EQ(folder.files(), 1u);
}

}  // namespace
}  // namespace dch::trajectory::test
