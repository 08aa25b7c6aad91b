// SPDX-License-Identifier: MIT
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <dch/error.hpp>
#include <dch/executor.hpp>

namespace dch {
namespace {

class ThreadPool final : public Executor {
 public:
  explicit ThreadPool(int threads) {
    try {
      for (int k = 1; k < threads; ++k) workers_.emplace_back([this] { work(); });
    } catch (const std::system_error& error) {
      close();
      throw Error("of a pool of " + std::to_string(threads) + " threads only " +
                  std::to_string(workers_.size() + 1) + " can be had (" + error.what() + "); choose fewer");
    }
  }
  ~ThreadPool() override { close(); }
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const override { return static_cast<int>(workers_.size()) + 1; }

  void run(int parts, const std::function<void(int)>& task) override {
    std::unique_lock lock(mutex_);
    task_ = &task;
    next_ = 0;
    parts_ = parts;
    open_ = parts;
    error_ = nullptr;
    wake_.notify_all();
    take_parts(lock);
    done_.wait(lock, [this] { return open_ == 0; });
    task_ = nullptr;
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closing_ = true;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [this] { return closing_ || next_ < parts_; });
      if (closing_) return;
      take_parts(lock);
    }
  }

  /// Runs parts as long as there are any to begin.
  void take_parts(std::unique_lock<std::mutex>& lock) {
    while (next_ < parts_) {
      const int part = next_++;
      const std::function<void(int)>& task = *task_;
      lock.unlock();
      std::exception_ptr error;
      try {
        task(part);
      } catch (...) {
        error = std::current_exception();
      }
      lock.lock();
      if (error && !error_) error_ = error;
      if (--open_ == 0) done_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  const std::function<void(int)>* task_ = nullptr;
  int next_ = 0, parts_ = 0;  ///< parts not begun yet
  int open_ = 0;              ///< parts that have not ended
  std::exception_ptr error_;
  bool closing_ = false;
  std::vector<std::thread> workers_;  // last, so that what they use is there when they start
};

}  // namespace

std::unique_ptr<Executor> make_thread_pool(int threads) {
  if (threads < 1 || threads > 4096)
    throw InvalidParameter("a pool of " + std::to_string(threads) + " threads; choose 1 to 4096");
  return std::make_unique<ThreadPool>(threads);
}

}  // namespace dch
