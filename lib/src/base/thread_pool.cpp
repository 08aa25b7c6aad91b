// SPDX-License-Identifier: MIT
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <sched.h>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>

namespace dch {
namespace {

constexpr int kSpins = 2000;  ///< 53 microseconds on Zen 4

/// Whether that many threads of this process may run at once: one that spins would else hold up another.
bool has_processors_for(int threads) {
  cpu_set_t allowed;
  return sched_getaffinity(0, sizeof allowed, &allowed) == 0 && CPU_COUNT(&allowed) >= threads;
}

class ThreadPool final : public Executor {
 public:
  explicit ThreadPool(int threads) : spins_(has_processors_for(threads) ? kSpins : 0) {
    try {
      for (int k = 1; k < threads; ++k) workers_.emplace_back([this, k] { work(k); });
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
    Job job(task, parts, threads());
    std::unique_lock lock(mutex_);
    if (parts > 1) {  // which the others may help with
      job.next = newest_;
      newest_ = &job;
      wake_.notify_all();
    }
    take_parts(job, 0, lock);
    if (job.open > 0) {
      lock.unlock();
      spin_until([&] { return job.open == 0; });
      lock.lock();
    }
    ended_.wait(lock, [&] { return job.open == 0; });
    if (job.error) std::rethrow_exception(job.error);
  }

 private:
  /// One call of run(), on the stack of its caller. The caller begins parts of its own job only and then
  /// waits for those that others have begun. A part waits only for jobs that it has started itself, so no two
  /// threads wait for each other, however calls are nested.
  ///
  /// Each thread has a share of the parts, which it begins in their order, and then helps that which has the
  /// most left. So the same parts of calls that follow each other are mostly run by the same thread, which
  /// has what they read and write in its cache.
  struct Job {
    Job(const std::function<void(int)>& to_do, int count, int threads)
        : task(to_do), parts(count), open(count), shares(static_cast<std::size_t>(threads)) {
      for (int k = 0; k < threads; ++k)
        shares[static_cast<std::size_t>(k)] = {share_begin(count, k, threads),
                                               share_begin(count, k + 1, threads)};
    }
    /// @pre not all have begun
    int begin_part(int thread) {
      ++begun;
      Share* from = &shares[static_cast<std::size_t>(thread)];
      if (from->first < from->last) return from->first++;
      for (Share& share : shares)
        if (share.last - share.first > from->last - from->first) from = &share;
      return --from->last;
    }

    struct Share {
      int first = 0, last = 0;
    };
    const std::function<void(int)>& task;
    const int parts;
    std::atomic<int> open;      ///< parts that have not ended
    int begun = 0;              ///< parts
    std::vector<Share> shares;  ///< by thread, parts that have not begun
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

  void work(int thread) {
    const auto is_wanted = [this] { return closing_ || newest_ != nullptr; };
    for (;;) {
      spin_until(is_wanted);
      std::unique_lock lock(mutex_);
      wake_.wait(lock, is_wanted);
      if (closing_) return;
      take_parts(*newest_, thread, lock);  // which older jobs wait for, if it is nested
    }
  }

  /// Looks for some microseconds before a thread goes to sleep: to wake it takes tens of them, and a list is
  /// made by calls that follow each other at once.
  template <class Condition>
  void spin_until(const Condition& condition) const {
    for (int k = 0; k < spins_ && !condition(); ++k) pause();
  }
  static void pause() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
  }

  /// Runs parts of a job as long as there are any to begin. When it returns, the job may be gone.
  void take_parts(Job& job, int thread, std::unique_lock<std::mutex>& lock) {
    while (job.begun < job.parts) {
      const int part = job.begin_part(thread);
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
    if (newest_ == &job) {
      newest_ = job.next;
      return;
    }
    for (Job* before = newest_; before != nullptr; before = before->next) {
      if (before->next != &job) continue;
      before->next = job.next;
      return;
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, ended_;  ///< for a job, and for the last part of one
  // Changed under the mutex; a thread that spins reads them without it.
  std::atomic<Job*> newest_{nullptr};  ///< of the jobs with parts to begin
  std::atomic<bool> closing_{false};
  const int spins_;
  std::vector<std::thread> workers_;  // last, so that what they use is there when they start
};

}  // namespace

std::unique_ptr<Executor> make_thread_pool(int threads) {
  if (threads < 1 || threads > 4096)
    throw InvalidParameter("a pool of " + std::to_string(threads) + " threads; choose 1 to 4096");
  return std::make_unique<ThreadPool>(threads);
}

}  // namespace dch
