// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_POOL_EXECUTOR_H_
#define OPENMM_DCH_POOL_EXECUTOR_H_

#include <atomic>
#include <openmm/internal/ThreadPool.h>

#include <dch/base/executor.hpp>

namespace OpenMMDCH {

/// Lends the threads of OpenMM's pool to the library. The pool outlives it. OpenMM's pool knows one task at a
/// time: a run that begins while another one has its threads, on another thread or around it, calls its parts
/// on the thread that it was called from. Others may not use the pool meanwhile, neither OpenMM nor another
/// executor: the kernels of a Context, which share one, are called one after the other.
class PoolExecutor : public dch::Executor {
 public:
  explicit PoolExecutor(OpenMM::ThreadPool& threadPool) : pool(threadPool) {}
  int threads() const override { return pool.getNumThreads(); }
  void run(int parts, const std::function<void(int)>& task) override;

 private:
  OpenMM::ThreadPool& pool;
  std::atomic<bool> busy{false};  ///< whether a run has the pool's threads
};

}  // namespace OpenMMDCH

#endif
