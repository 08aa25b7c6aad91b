// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>

#include <dch/base/executor.hpp>

namespace dch::detail {

/// Has workers take turns: each takes the next task when it has none, and does some of the work on it when
/// all tasks before have had theirs done.
class Turns {
 public:
  explicit Turns(int tasks) : tasks_(tasks) {}
  /// The next task, or -1 if all are taken.
  int take() {
    const std::lock_guard lock(mutex_);
    return taken_ < tasks_ ? taken_++ : -1;
  }
  template <class Work>
  void in_turn(int task, const Work& work) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return done_ == task; });
    lock.unlock();
    work();
    lock.lock();
    ++done_;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int tasks_, taken_ = 0, done_ = 0;
};

/// task(0) .. task(parts - 1), on the executor's threads if there are several.
inline void run_parts(Executor* executor, int parts, const std::function<void(int)>& task) {
  if (parts == 1) {
    task(0);
  } else {
    executor->run(parts, task);
  }
}

}  // namespace dch::detail
