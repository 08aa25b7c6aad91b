// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#pragma GCC visibility push(default)
namespace dch {

/// Runs the parts of a task, perhaps side by side: how a host lends its threads. Results do not depend on how
/// many there are.
///
/// One executor may serve several objects, hence several threads may call run() at once; and a part may call
/// run() of the executor that runs it. Each call has to return when its own parts have ended, whatever other
/// calls there are. A part may wait for another one of its call that has begun before it, so a thread that
/// waits may be lent to parts of its own call only. Where a host's threads cannot be shared like that, run()
/// calls all parts on the thread that it was called from while the others are taken.
class Executor {
 public:
  virtual ~Executor() = default;

  /// How many parts can run at once, at least 1.
  virtual int threads() const = 0;

  /// Calls task(0) .. task(parts - 1), each once, on any threads and in any order, and returns when all have
  /// ended. If some threw, one of the exceptions is thrown on, after all have ended. Any number of threads
  /// may call it at once, and parts may.
  virtual void run(int parts, const std::function<void(int)>& task) = 0;
};

/// A pool of `threads` - 1 standing threads and those that call run(), any number of them at once. It must
/// outlive all calls. A thread without work looks for some for about 50 microseconds before it sleeps, if the
/// process may use as many processors as there are threads.
/// @throws InvalidParameter unless 1 <= threads <= 4096, Error if the system does not give that many.
std::unique_ptr<Executor> make_thread_pool(int threads);

/// Where the k-th of `parts` about equal shares of [0, count) begins, k from 0 to `parts`.
template <class Count>
Count share_begin(Count count, int k, int parts) {
  return static_cast<Count>(static_cast<std::int64_t>(count) * k / parts);
}

/// Calls task(first, last) for ranges that make up [0, count), one for each thread of `executor`; if that is
/// null or has one thread, for the whole.
template <class Count, class Task>
void for_ranges(Executor* executor, Count count, const Task& task) {
  const int parts = executor ? executor->threads() : 1;
  if (parts == 1) return task(Count{0}, count);
  executor->run(
      parts, [&](int part) { task(share_begin(count, part, parts), share_begin(count, part + 1, parts)); });
}

}  // namespace dch
#pragma GCC visibility pop
