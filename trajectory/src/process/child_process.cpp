// SPDX-License-Identifier: MIT
#include "process/child_process.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <mutex>
#include <sstream>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace dch::trajectory {
namespace {

/// A descriptor that closes itself unless it has been released.
class Descriptor {
 public:
  Descriptor(int value, const char* what) : value_(value) {
    if (value_ < 0) throw std::system_error(errno, std::generic_category(), what);
  }
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return value_; }
  int release() { return std::exchange(value_, -1); }

 private:
  int value_;
};

/// A handler of the host, run in the child, would do the host's work twice (remove its temporary files, say).
/// Signals that a terminal sends to both are for the host to answer: the child ends when the host hangs up.
void reset_handlers() {
  std::set_terminate(std::abort);
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, SIG_IGN);
}

/// Exit handlers run in reverse order, so this one comes before all those of the host.
void skip_exit_handlers_of_host() {
  std::atexit([] { ::_exit(EXIT_FAILURE); });
}

void redirect_streams(int messages) {
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  ::dup2(nowhere, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(messages, STDERR_FILENO);
}

[[noreturn]] void run_child(const std::function<void(int)>& body, int socket, int messages) {
  reset_handlers();
  skip_exit_handlers_of_host();
  redirect_streams(messages);
  const rlimit no_core_file{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core_file);
  try {
    body(socket);
  } catch (...) {
    // The caller's body reports its exceptions through the socket; one that gets here ends the child without
    // an answer.
    ::_exit(EXIT_FAILURE);
  }
  ::_exit(EXIT_SUCCESS);
}

std::string describe_status(int status) {
  if (!WIFSIGNALED(status)) return "it ended the process";
  if (WTERMSIG(status) == SIGPROF) return "no end came in sight (an endless loop)";
  return fmt::format("it was ended by the signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
}

}  // namespace

ChildProcess::ChildProcess(const std::function<void(int)>& body) {
  // Two threads that start children at once would hand each child the other's sockets, and a connection that
  // is open in a stranger never ends.
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);

  Descriptor messages(::memfd_create("dch-messages", MFD_CLOEXEC), "a nameless file cannot be made");
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::system_error(errno, std::generic_category(), "sockets cannot be made");
  }
  Descriptor ours(ends[0], "socket"), childs(ends[1], "socket");
  constexpr int kReadAhead = 1 << 20;
  ::setsockopt(childs.get(), SOL_SOCKET, SO_SNDBUF, &kReadAhead,
               sizeof kReadAhead);  // a smaller one works too

  id_ = ::fork();
  if (id_ < 0) throw std::system_error(errno, std::generic_category(), "a process cannot be started");
  if (id_ == 0) {
    ::close(ours.release());
    run_child(body, childs.get(), messages.get());
  }
  socket_ = ours.release();
  messages_ = messages.release();
}

ChildProcess::~ChildProcess() {
  ::close(socket_);
  ::close(messages_);
  if (id_ < 0) return;
  ::kill(id_, SIGKILL);
  while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void ChildProcess::set_patience(int seconds) const {
  const timeval patience{seconds, 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
}

std::string ChildProcess::wait_and_describe() {
  if (id_ < 0) return "it ended the process";
  ::shutdown(socket_, SHUT_RDWR);  // one that waits for this process would wait for ever
  // A child whose connection has ended is about to end itself; another one hangs.
  constexpr int kTries = 1000, kMicroseconds = 1000;
  int status = 0;
  pid_t waited = 0;
  for (int k = 0; k < kTries && waited == 0; ++k) {
    if (k > 0) ::usleep(kMicroseconds);
    waited = ::waitpid(id_, &status, WNOHANG);
  }
  const bool hangs = waited == 0;
  if (hangs) {
    ::kill(id_, SIGKILL);
    do {
      waited = ::waitpid(id_, &status, 0);
    } while (waited < 0 && errno == EINTR);
  }
  // A host that ignores SIGCHLD leaves no status to fetch.
  std::string text = hangs           ? "no answer came (it hung, or sent what is no frame)"
                     : waited == id_ ? describe_status(status)
                                     : "it ended the process";
  id_ = -1;
  if (const std::string words = last_words(); !words.empty()) text += "; its last words: " + words;
  return text;
}

std::string ChildProcess::last_words() const {
  constexpr std::size_t kMax = 4096;
  constexpr std::size_t kShown = 600;
  std::string raw(kMax, '\0');
  const off_t size = ::lseek(messages_, 0, SEEK_END);
  const off_t from = size > static_cast<off_t>(kMax) ? size - static_cast<off_t>(kMax) : 0;
  const ssize_t got = ::pread(messages_, raw.data(), raw.size(), from);
  raw.resize(got > 0 ? static_cast<std::size_t>(got) : 0);

  std::istringstream words(raw);
  std::string text;
  for (std::string word; words >> word;) text += (text.empty() ? "" : " ") + word;
  return text.size() > kShown ? "... " + text.substr(text.size() - kShown) : text;
}

void ChildProcess::clear_messages() {
  if (::ftruncate(STDERR_FILENO, 0) == 0) ::lseek(STDERR_FILENO, 0, SEEK_SET);
}

void ChildProcess::restart_watchdog(int seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = seconds;
  ::setitimer(ITIMER_PROF, &timer, nullptr);  // SIGPROF ends the process
}

}  // namespace dch::trajectory
