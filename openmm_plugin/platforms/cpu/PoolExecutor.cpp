// SPDX-License-Identifier: MIT
#include "PoolExecutor.h"

#include <atomic>
#include <exception>
#include <mutex>

namespace OpenMMDCH {

void PoolExecutor::run(int parts, const std::function<void(int)>& task) {
  if (threads() == 1 || parts <= 1) {
    for (int part = 0; part < parts; ++part) task(part);
    return;
  }
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr error;
  pool.execute([&](OpenMM::ThreadPool&, int) {
    for (int part = next++; part < parts; part = next++) {
      try {
        task(part);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
      }
    }
  });
  pool.waitForThreads();
  if (error) std::rethrow_exception(error);
}

}  // namespace OpenMMDCH
