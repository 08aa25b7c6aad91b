// SPDX-License-Identifier: MIT
// A library to be loaded before all others (LD_PRELOAD): it notes the calls of the system that have to do
// with the files of one folder or with the sockets between processes, and makes one of them fail.
//
//   DCH_CALLS_FOLDER   the folder, as an absolute path
//   DCH_CALLS_LOG      a file of kLogBytes zeros; a line for each call comes into it:
//                      "PROCESS NUMBER FUNCTION NAME" and then " !" if it was made to fail. PROCESS is 0 for
//                      the first one and counts the children that it starts, NUMBER counts the calls of a
//                      process from 0. A fork() names "child", or "child_beside_threads" where threads run
//   DCH_CALLS_FAULT    "PROCESS NUMBER FAULT": the number of an error, or "short" (half the bytes are read or
//                      written), or "kill" (half the bytes, then SIGKILL); none at all if it is not set
//
// Nothing is asked of the system itself, so that it works where a process has given up its rights.
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <unistd.h>

namespace {

constexpr std::size_t kLogBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxDescriptors = 1024;
constexpr std::size_t kNameBytes = 64;

struct Log {
  std::atomic<std::size_t> used;
  char text[kLogBytes - sizeof(std::size_t)];
};

struct Fault {
  int error = 0;         // 0: the call succeeds
  bool is_half = false;  // reads and writes: half of the bytes
  bool is_deadly = false;
};

Log* log = nullptr;
std::string_view folder;
int process = 0, children = 0;
long calls = 0;
int fault_process = -1;
long fault_call = -1;
Fault wanted;
/// Names of the open files that count; empty for others.
std::array<std::array<char, kNameBytes>, kMaxDescriptors> names;

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

__attribute__((constructor)) void start() {
  const char* const log_path = std::getenv("DCH_CALLS_LOG");
  const char* const path = std::getenv("DCH_CALLS_FOLDER");
  if (!log_path || !path) return;
  folder = path;
  const int file = next<int (*)(const char*, int, ...)>("open")(log_path, O_RDWR | O_CLOEXEC);
  void* const memory = ::mmap(nullptr, kLogBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) std::abort();
  next<int (*)(int)>("close")(file);
  log = static_cast<Log*>(memory);
  const char* const fault = std::getenv("DCH_CALLS_FAULT");
  if (!fault) return;
  char what[16] = "";
  if (std::sscanf(fault, "%d %ld %15s", &fault_process, &fault_call, what) != 3) std::abort();
  wanted.is_deadly = std::string_view(what) == "kill";
  wanted.is_half = wanted.is_deadly || std::string_view(what) == "short";
  if (!wanted.is_half) wanted.error = std::atoi(what);
}

/// Counts a call that has to do with the file of that name, and says what becomes of it.
Fault strike(const char* function, const char* name) {
  if (!log || !name || name[0] == '\0') return {};
  const bool now = process == fault_process && calls == fault_call;
  char line[2 * kNameBytes];
  const int size =
      std::snprintf(line, sizeof line, "%d %ld %s %s%s\n", process, calls, function, name, now ? " !" : "");
  const std::size_t at = log->used.fetch_add(static_cast<std::size_t>(size));
  if (at + static_cast<std::size_t>(size) < sizeof log->text)
    std::memcpy(log->text + at, line, static_cast<std::size_t>(size));
  ++calls;
  return now ? wanted : Fault{};
}

const char* name_of(int descriptor) {
  const bool known = descriptor >= 0 && descriptor < static_cast<int>(kMaxDescriptors);
  return known ? names[static_cast<std::size_t>(descriptor)].data() : nullptr;
}

void set_name(int descriptor, const char* name) {
  if (descriptor < 0 || descriptor >= static_cast<int>(kMaxDescriptors)) return;
  std::snprintf(names[static_cast<std::size_t>(descriptor)].data(), kNameBytes, "%s", name);
}

/// The last part of a path in the folder, or what an open descriptor leads to; null for others.
const char* name_in_folder(const char* path) {
  int descriptor = -1;
  if (std::sscanf(path, "/proc/self/fd/%d", &descriptor) == 1) return name_of(descriptor);
  if (folder.empty() || std::strncmp(path, folder.data(), folder.size()) != 0) return nullptr;
  const char* const slash = std::strrchr(path, '/');
  return slash[1] == '\0' ? "folder" : slash + 1;
}

bool threads_run() {
  DIR* const tasks = ::opendir("/proc/self/task");
  if (!tasks) std::abort();
  int entries = 0;
  while (::readdir(tasks)) ++entries;
  ::closedir(tasks);
  return entries > 3;  // the folder itself, the one above, and this thread
}

/// A call that does nothing but fail, or is done.
template <class Call>
int do_or_fail(const char* function, const char* name, Call call) {
  const Fault fault = strike(function, name);
  if (fault.is_deadly) ::kill(::getpid(), SIGKILL);
  if (fault.error == 0) return call();
  errno = fault.error;
  return -1;
}

/// A call that moves bytes.
template <class Call>
ssize_t move_or_fail(const char* function, int descriptor, std::size_t size, Call call) {
  const Fault fault = strike(function, name_of(descriptor));
  if (fault.error != 0) {
    errno = fault.error;
    return -1;
  }
  const ssize_t moved = call(fault.is_half ? (size + 1) / 2 : size);
  if (fault.is_deadly) ::kill(::getpid(), SIGKILL);
  return moved;
}

int open_or_fail(const char* function, const char* path, int flags, mode_t mode) {
  const char* const name = name_in_folder(path);
  static const auto real = next<int (*)(const char*, int, ...)>("open");
  const int file = do_or_fail((flags & O_ACCMODE) == O_RDONLY ? "open" : function, name,
                              [&] { return real(path, flags, mode); });
  set_name(file, name ? name : "");
  return file;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open_or_fail("create", path, flags, mode);
}

ssize_t read(int file, void* data, size_t size) {
  static const auto real = next<ssize_t (*)(int, void*, size_t)>("read");
  return move_or_fail("read", file, size, [&](size_t some) { return real(file, data, some); });
}

ssize_t pread(int file, void* data, size_t size, off_t offset) {
  static const auto real = next<ssize_t (*)(int, void*, size_t, off_t)>("pread");
  return move_or_fail("pread", file, size, [&](size_t some) { return real(file, data, some, offset); });
}

ssize_t write(int file, const void* data, size_t size) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  return move_or_fail("write", file, size, [&](size_t some) { return real(file, data, some); });
}

ssize_t pwrite(int file, const void* data, size_t size, off_t offset) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  return move_or_fail("pwrite", file, size, [&](size_t some) { return real(file, data, some, offset); });
}

ssize_t send(int socket, const void* data, size_t size, int flags) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t, int)>("send");
  return move_or_fail("send", socket, size, [&](size_t some) { return real(socket, data, some, flags); });
}

int fsync(int file) {
  static const auto real = next<int (*)(int)>("fsync");
  return do_or_fail("fsync", name_of(file), [&] { return real(file); });
}

int ftruncate(int file, off_t size) noexcept {
  static const auto real = next<int (*)(int, off_t)>("ftruncate");
  return do_or_fail("ftruncate", name_of(file), [&] { return real(file, size); });
}

int fchmod(int file, mode_t mode) noexcept {
  static const auto real = next<int (*)(int, mode_t)>("fchmod");
  return do_or_fail("fchmod", name_of(file), [&] { return real(file, mode); });
}

int fchown(int file, uid_t owner, gid_t group) noexcept {
  static const auto real = next<int (*)(int, uid_t, gid_t)>("fchown");
  return do_or_fail("fchown", name_of(file), [&] { return real(file, owner, group); });
}

/// As Linux has it: the descriptor is closed, whatever is said.
int close(int file) {
  static const auto real = next<int (*)(int)>("close");
  char name[kNameBytes];
  std::snprintf(name, sizeof name, "%s", name_of(file) ? name_of(file) : "");
  set_name(file, "");
  const int closed = real(file);
  return do_or_fail("close", name, [&] { return closed; });
}

int rename(const char* from, const char* to) noexcept {
  static const auto real = next<int (*)(const char*, const char*)>("rename");
  return do_or_fail("rename", name_in_folder(to), [&] { return real(from, to); });
}

int socketpair(int domain, int type, int protocol, int ends[2]) noexcept {
  static const auto real = next<int (*)(int, int, int, int[2])>("socketpair");
  const int made = do_or_fail("socketpair", "socket", [&] { return real(domain, type, protocol, ends); });
  for (int k = 0; made == 0 && k < 2; ++k) set_name(ends[k], "socket");
  return made;
}

int memfd_create(const char* name, unsigned flags) noexcept {
  static const auto real = next<int (*)(const char*, unsigned)>("memfd_create");
  return do_or_fail("memfd_create", "messages", [&] { return real(name, flags); });
}

pid_t fork() noexcept {
  static const auto real = next<pid_t (*)()>("fork");
  const char* const name = threads_run() ? "child_beside_threads" : "child";
  const pid_t id = do_or_fail("fork", name, [&] { return real(); });
  if (id > 0) ++children;
  if (id != 0) return id;
  process = ++children;
  calls = 0;
  return 0;
}

}  // extern "C"
