// SPDX-License-Identifier: MIT
// A library to be loaded before all others (LD_PRELOAD): it counts the allocations that a process makes from
// its main() on, and makes some of them fail.
//
//   DCH_MEMORY_LOG     a file of kMaxProcesses numbers of 8 bytes: how often each process allocated, and how
//                      often it was refused. Process 0 is the first one, others are the children it starts
//   DCH_MEMORY_FAULT   "PROCESS NUMBER HOW": the allocation, counted from 0, and "once", or "always" for all
//                      that follow as well; none at all if it is not set
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <limits>
#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>

// glibc's own allocation, which needs no dlsym() and so no memory to be found.
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
}

namespace {

constexpr int kMaxProcesses = 16;

struct Tally {
  std::atomic<long> allocations, refusals;
};
using Log = std::array<Tally, kMaxProcesses>;

Log* log = nullptr;  ///< null until main() starts
int process = 0, children = 0;
int fault_process = -1;
long first_to_fail = 0, last_to_fail = -1;

bool is_refused() {
  if (!log) return false;
  Tally& tally = (*log)[static_cast<std::size_t>(std::min(process, kMaxProcesses - 1))];
  const long k = tally.allocations.fetch_add(1);
  if (process != fault_process || k < first_to_fail || k > last_to_fail) return false;
  tally.refusals.fetch_add(1);
  errno = ENOMEM;
  return true;
}

void start() {
  const char* const path = std::getenv("DCH_MEMORY_LOG");
  if (!path) return;
  char how[8] = "once";
  if (const char* const fault = std::getenv("DCH_MEMORY_FAULT")) {
    if (std::sscanf(fault, "%d %ld %7s", &fault_process, &first_to_fail, how) != 3) std::abort();
  }
  last_to_fail = std::strcmp(how, "always") == 0 ? std::numeric_limits<long>::max() : first_to_fail;
  const int file = ::open(path, O_RDWR | O_CLOEXEC);
  void* const memory = ::mmap(nullptr, sizeof(Log), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) std::abort();
  ::close(file);
  log = static_cast<Log*>(memory);
}

using Main = int (*)(int, char**, char**);
Main real_main = nullptr;

int counted_main(int argc, char** argv, char** environment) {
  start();
  return real_main(argc, argv, environment);
}

}  // namespace

extern "C" {

void* malloc(size_t size) noexcept { return is_refused() ? nullptr : __libc_malloc(size); }

void* calloc(size_t count, size_t size) noexcept {
  return is_refused() ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* memory, size_t size) noexcept {
  return is_refused() ? nullptr : __libc_realloc(memory, size);
}

void* memalign(size_t alignment, size_t size) noexcept {
  return is_refused() ? nullptr : __libc_memalign(alignment, size);
}

void* aligned_alloc(size_t alignment, size_t size) noexcept { return memalign(alignment, size); }

int posix_memalign(void** memory, size_t alignment, size_t size) noexcept {
  void* const found = memalign(alignment, size);
  if (found) *memory = found;
  return found ? 0 : ENOMEM;
}

pid_t fork() noexcept {
  static const auto real = reinterpret_cast<pid_t (*)()>(::dlsym(RTLD_NEXT, "fork"));
  const pid_t id = real();
  if (id > 0) ++children;
  if (id == 0) process = ++children;
  return id;
}

/// What the start of every program calls.
int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(), void (*rtld_fini)(),
                      void* stack_end) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  real_main = main;
  return reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"))(counted_main, argc, argv, init,
                                                                          fini, rtld_fini, stack_end);
}

}  // extern "C"
