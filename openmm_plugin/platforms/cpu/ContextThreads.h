// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_CONTEXT_THREADS_H_
#define OPENMM_DCH_CONTEXT_THREADS_H_

#include <memory>
#include <openmm/internal/ThreadPool.h>

#include <dch/base/executor.hpp>

namespace OpenMMDCH {

/// As many threads for the library as OpenMM's pool of a Context has, the same for all who ask for them with
/// that pool while some hold them. OpenMM's own threads sleep meanwhile: they would have to be woken for each
/// loop, of which a step has several that take less time than that, and the library's look for the next one
/// for a while first.
std::shared_ptr<dch::Executor> threadsBeside(const OpenMM::ThreadPool& pool);

}  // namespace OpenMMDCH

#endif
