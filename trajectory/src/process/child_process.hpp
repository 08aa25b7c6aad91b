// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <sys/types.h>

namespace dch::trajectory {

/// A copy of this process that runs one function and talks with its parent through a pair of sockets.
///
/// In the child, stdin and stdout are /dev/null, stderr is kept in a nameless file, signal handlers are
/// reset, signals from the terminal ignored, no core file is written, and exit() ends it at once, without the
/// exit handlers, stream buffers and static objects that belong to the host. The destructor kills a child
/// that still runs.
///
/// A process should have started no threads of its own yet: the child has copies of the locks that they hold
/// and none of the threads, so it may wait for ever. (The C library's own locks are safe; the allocators of
/// sanitizers, say, are not.)
class ChildProcess {
 public:
  /// @param body gets the child's socket; when it returns, the child ends
  /// @throws std::system_error if the system has no process, socket or memory left.
  explicit ChildProcess(const std::function<void(int socket)>& body);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// The parent's socket.
  int socket() const { return socket_; }

  /// Reading from socket() fails after so many seconds without a byte.
  void set_patience(int seconds) const;

  /// Waits for the child to end, and ends it if it has not within a second; what made it end and the last of
  /// what it wrote to stderr, in words.
  std::string wait_and_describe();

  /// In the child: forgets what it wrote to stderr, so that the nameless file stays small.
  static void clear_messages();

  /// In the child: ends it unless called again before it has used `seconds` of processor time. Waiting for a
  /// slow disk does not count.
  static void restart_watchdog(int seconds);

 private:
  std::string last_words() const;

  int socket_ = -1;
  int messages_ = -1;  ///< the nameless file
  pid_t id_ = -1;
};

}  // namespace dch::trajectory
