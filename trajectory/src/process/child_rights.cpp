// SPDX-License-Identifier: MIT
#include "process/child_rights.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace dch::trajectory {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;
#endif

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1
#endif
#endif

/// System calls that reading and sending take. Memory may be mapped, but not as code: see kMemoryCalls.
constexpr int kAllowedCalls[] = {
#if defined(__SANITIZE_ADDRESS__)
    // The sanitizers look at the stack when an exception is thrown, and at memory by way of a pipe.
    __NR_sigaltstack,  __NR_pipe2,
#if defined(__NR_pipe)
    __NR_pipe,
#endif
#endif
    __NR_read,         __NR_pread64,      __NR_lseek,        __NR_write,          __NR_writev,    __NR_sendto,
    __NR_recvfrom,     __NR_ftruncate,    __NR_munmap,       __NR_mremap,         __NR_madvise,   __NR_brk,
    __NR_futex,        __NR_sched_yield,  __NR_setitimer,    __NR_clock_gettime,  __NR_getpid,    __NR_gettid,
    __NR_gettimeofday, __NR_rt_sigreturn, __NR_rt_sigaction, __NR_rt_sigprocmask, __NR_getrandom, __NR_close,
    __NR_exit,         __NR_exit_group};

constexpr int kMemoryCalls[] = {__NR_mmap, __NR_mprotect};  ///< the third argument is the protection

constexpr auto kLoad = static_cast<std::uint16_t>(BPF_LD | BPF_W | BPF_ABS);
constexpr auto kIfEqual = static_cast<std::uint16_t>(BPF_JMP | BPF_JEQ | BPF_K);
constexpr auto kIfAnyBit = static_cast<std::uint16_t>(BPF_JMP | BPF_JSET | BPF_K);
constexpr auto kReturn = static_cast<std::uint16_t>(BPF_RET | BPF_K);

/// One `if` a call, each with its own return, so that no jump is longer than a few instructions.
std::vector<sock_filter> make_filter() {
  constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;
  const auto offset_of_argument = static_cast<std::uint32_t>(offsetof(seccomp_data, args) + 2 * 8);
  std::vector<sock_filter> filter{
      BPF_STMT(kLoad, offsetof(seccomp_data, arch)),
      BPF_JUMP(kIfEqual, kArchitecture, 1, 0),
      BPF_STMT(kReturn, SECCOMP_RET_KILL_PROCESS),
      BPF_STMT(kLoad, offsetof(seccomp_data, nr)),
  };
  for (const int call : kAllowedCalls) {
    filter.push_back(BPF_JUMP(kIfEqual, static_cast<std::uint32_t>(call), 0, 1));
    filter.push_back(BPF_STMT(kReturn, SECCOMP_RET_ALLOW));
  }
  for (const int call : kMemoryCalls) {
    filter.push_back(BPF_JUMP(kIfEqual, static_cast<std::uint32_t>(call), 0, 4));
    filter.push_back(BPF_STMT(kLoad, offset_of_argument));
    filter.push_back(BPF_JUMP(kIfAnyBit, PROT_EXEC, 0, 1));
    filter.push_back(BPF_STMT(kReturn, kRefuse));
    filter.push_back(BPF_STMT(kReturn, SECCOMP_RET_ALLOW));
  }
  filter.push_back(BPF_STMT(kReturn, kRefuse));
  return filter;
}

void close_others(std::vector<int> kept) {
  std::sort(kept.begin(), kept.end());
  unsigned from = STDERR_FILENO + 1;
  for (const int descriptor : kept) {
    const auto here = static_cast<unsigned>(descriptor);
    if (here > from) ::close_range(from, here - 1, 0);
    from = std::max(from, here + 1);
  }
  ::close_range(from, ~0U, 0);
}

void set_limit(__rlimit_resource which, std::int64_t most) {
  const rlimit limit{static_cast<rlim_t>(most), static_cast<rlim_t>(most)};
  ::setrlimit(which, &limit);
}

std::int64_t address_space_in_use() {
  std::int64_t pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
    long long value = 0;
    if (std::fscanf(file, "%lld", &value) == 1) pages = value;
    std::fclose(file);
  }
  return pages * ::sysconf(_SC_PAGESIZE);
}

}  // namespace

bool give_up_rights(const ChildRights& rights) {
  constexpr std::int64_t kMessages = 64 * 1024;  // what the child may leave on stderr, which is a file
  set_limit(RLIMIT_AS, address_space_in_use() + rights.memory);
  close_others(rights.descriptors);
#if !defined(__SANITIZE_ADDRESS__)
  set_limit(RLIMIT_NOFILE, 0);
#endif
  set_limit(RLIMIT_NPROC, 0);
  set_limit(RLIMIT_FSIZE, kMessages);
  if (kArchitecture == 0) return false;
  std::vector<sock_filter> filter = make_filter();
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace dch::trajectory
