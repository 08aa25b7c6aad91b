// SPDX-License-Identifier: MIT
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>

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
    if (parts < 1) return;
    Job job{task, parts, parts};
    std::unique_lock lock(mutex_);
    if (parts > 1) {  // which the others may help with
      job.next = newest_;
      newest_ = &job;
      wake_.notify_all();
    }
    take_parts(job, lock);
    ended_.wait(lock, [&] { return job.open == 0; });
    if (job.error) std::rethrow_exception(job.error);
  }

 private:
  /// One call of run(), on the stack of its caller. The caller begins parts of its own job only and then
  /// waits for those that others have begun. A part waits only for jobs that it has started itself, so no two
  /// threads wait for each other, however calls are nested.
  struct Job {
    const std::function<void(int)>& task;
    int parts;
    int open;       ///< parts that have not ended
    int begun = 0;  ///< parts
    std::exception_ptr error = nullptr;
    Job* next = nullptr;  ///< the job that came before it, of those with parts to begin
  };

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
      wake_.wait(lock, [this] { return closing_ || newest_ != nullptr; });
      if (closing_) return;
      take_parts(*newest_, lock);  // which older jobs wait for, if it is nested
    }
  }

  /// Runs parts of a job as long as there are any to begin. When it returns, the job may be gone.
  void take_parts(Job& job, std::unique_lock<std::mutex>& lock) {
    while (job.begun < job.parts) {
      const int part = job.begun++;
      if (job.begun == job.parts) leave_out(job);
      lock.unlock();
      std::exception_ptr error;
      try {
        job.task(part);
      } catch (...) {
        error = std::current_exception();
      }
      lock.lock();
      if (error && !job.error) job.error = std::move(error);
      if (--job.open > 0) continue;
      ended_.notify_all();
      return;
    }
  }

  /// Takes a job with no parts to begin out of the chain.
  void leave_out(const Job& job) {
    for (Job** link = &newest_; *link != nullptr; link = &(*link)->next) {
      if (*link != &job) continue;
      *link = job.next;
      return;
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, ended_;  ///< for a job, and for the last part of one
  Job* newest_ = nullptr;                 ///< of the jobs with parts to begin
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
