// SPDX-License-Identifier: MIT
#include "PoolExecutor.h"

#include <exception>
#include <mutex>

namespace OpenMMDCH {
namespace {

/// Takes parts of one run until there are none left, and keeps the first exception.
class Parts {
 public:
  Parts(int count, const std::function<void(int)>& toRun) : parts(count), task(toRun) {}
  void take() {
    for (int part = next++; part < parts; part = next++) {
      try {
        task(part);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
      }
    }
  }
  void throwOn() const {
    if (error) std::rethrow_exception(error);
  }

 private:
  int parts;
  const std::function<void(int)>& task;
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr error;
};

struct Release {
  std::atomic<bool>& busy;
  ~Release() { busy = false; }
};

}  // namespace

void PoolExecutor::run(int parts, const std::function<void(int)>& task) {
  Parts all(parts, task);
  if (threads() == 1 || parts <= 1 || busy.exchange(true)) {
    all.take();
  } else {
    const Release whenDone{busy};
    pool.execute([&](OpenMM::ThreadPool&, int) { all.take(); });
    pool.waitForThreads();
  }
  all.throwOn();
}

}  // namespace OpenMMDCH
