// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace dch {

/// Runs the parts of a task, perhaps side by side: how a host lends its threads. Results do not depend on how
/// many there are.
class Executor {
 public:
  virtual ~Executor() = default;

  /// How many parts can run at once, at least 1.
  virtual int threads() const = 0;

  /// Calls task(0) .. task(parts - 1), each once, on any threads and in any order, and returns when all have
  /// ended. If some threw, one of the exceptions is thrown on, after all have ended.
  virtual void run(int parts, const std::function<void(int)>& task) = 0;
};

/// A pool of `threads` - 1 standing threads and the one that calls run().
/// @throws InvalidParameter unless 1 <= threads <= 4096, Error if the system does not give that many.
std::unique_ptr<Executor> make_thread_pool(int threads);

/// Calls task(first, last) for ranges that make up [0, count), one for each thread of `executor`; if that is
/// null or has one thread, for the whole.
template <class Count, class Task>
void for_ranges(Executor* executor, Count count, const Task& task) {
  const int parts = executor ? executor->threads() : 1;
  if (parts == 1) return task(Count{0}, count);
  executor->run(parts, [&](int part) {
    const auto cut = [&](int k) { return static_cast<Count>(static_cast<std::int64_t>(count) * k / parts); };
    task(cut(part), cut(part + 1));
  });
}

}  // namespace dch
