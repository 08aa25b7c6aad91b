// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include <dch/base/executor.hpp>

namespace dch::python {

/// A pool of threads, made when it is first wanted. A process that was forked has none of its parent's
/// threads, so it makes a pool of its own, and leaves the other one alone.
class Threads {
 public:
  /// @throws InvalidParameter unless 1 <= count <= 4096, Error if the system does not give that many.
  explicit Threads(int count) : count_(count), pool_(make_thread_pool(count)), process_(getpid()) {}
  ~Threads() { leave(); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  int count() const { return count_; }
  /// Null for the thread of the caller alone.
  Executor* executor() {
    if (count_ == 1) return nullptr;
    if (process_ != getpid()) {
      leave();
      pool_ = make_thread_pool(count_);
      process_ = getpid();
    }
    return pool_.get();
  }

 private:
  void leave() {
    if (process_ != getpid()) static_cast<void>(pool_.release());
  }

  int count_;
  std::unique_ptr<Executor> pool_;
  pid_t process_;
};

/// The threads that there are now: others after a fork.
class PresentThreads final : public Executor {
 public:
  explicit PresentThreads(int count) : threads_(count) {}
  int threads() const override { return threads_.count(); }
  void run(int parts, const std::function<void(int)>& task) override {
    if (Executor* const pool = threads_.executor()) return pool->run(parts, task);
    for (int part = 0; part < parts; ++part) task(part);
  }

 private:
  Threads threads_;
};

/// Says of an object that a thread is using it, as long as this lives: the lock of the interpreter is given
/// up meanwhile, so that another thread might come.
class InUse {
 public:
  InUse(std::atomic<bool>& flag, const char* what) : flag_(flag) {
    if (flag_.exchange(true))
      throw std::runtime_error(std::string("another thread is using this ") + what +
                               "; an object serves one thread at a time, so make one for each");
  }
  ~InUse() { flag_ = false; }
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;

 private:
  std::atomic<bool>& flag_;
};

}  // namespace dch::python
