// SPDX-License-Identifier: MIT
#include "ContextThreads.h"

#include <map>
#include <mutex>

namespace OpenMMDCH {

std::shared_ptr<dch::Executor> threadsBeside(const OpenMM::ThreadPool& pool) {
  static std::mutex mutex;
  static std::map<const OpenMM::ThreadPool*, std::weak_ptr<dch::Executor>> threadsOf;
  const std::lock_guard<std::mutex> lock(mutex);
  for (auto it = threadsOf.begin(); it != threadsOf.end();)
    it = it->second.expired() ? threadsOf.erase(it) : std::next(it);
  std::weak_ptr<dch::Executor>& known = threadsOf[&pool];
  std::shared_ptr<dch::Executor> threads = known.lock();
  // Another pool may stand where an earlier one stood.
  if (!threads || threads->threads() != pool.getNumThreads()) {
    threads = dch::make_thread_pool(pool.getNumThreads());
    known = threads;
  }
  return threads;
}

}  // namespace OpenMMDCH
