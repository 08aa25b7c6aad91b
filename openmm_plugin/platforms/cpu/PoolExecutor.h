// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_POOL_EXECUTOR_H_
#define OPENMM_DCH_POOL_EXECUTOR_H_

#include <openmm/internal/ThreadPool.h>

#include <dch/executor.hpp>

namespace OpenMMDCH {

/// Lends the threads of OpenMM's pool to the library. The pool outlives it.
class PoolExecutor : public dch::Executor {
 public:
  explicit PoolExecutor(OpenMM::ThreadPool& threadPool) : pool(threadPool) {}
  int threads() const override { return pool.getNumThreads(); }
  void run(int parts, const std::function<void(int)>& task) override;

 private:
  OpenMM::ThreadPool& pool;
};

}  // namespace OpenMMDCH

#endif
