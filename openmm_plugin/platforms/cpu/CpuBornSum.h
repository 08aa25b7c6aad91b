// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_CPU_BORN_SUM_H_
#define OPENMM_DCH_CPU_BORN_SUM_H_

#include <memory>
#include <optional>
#include <vector>

#include <dch/forces/generalized_born.hpp>

#include "BornSum.h"
#include "ClusterPairKeeper.h"
#include "ContextThreads.h"

namespace OpenMMDCH {

/// A generalized Born model on the CPU platform: cluster pairs from double positions, SIMD kernels in single
/// precision, on as many threads as the platform has. In the few boxes where lists cannot be made, and where
/// radii differ too much for single precision, as on Reference.
class CpuBornSum : public BornSum {
 public:
  explicit CpuBornSum(const OpenMM::ThreadPool& threads) : executor(threadsBeside(threads)) {}

  void take(const BornModel& taken) override;

 protected:
  void follow(const HostState& state) override;
  void addIntegrals(const HostState& state) override;
  double addEnergies(const HostState& state, bool includeEnergy) override;
  void addChain(const HostState& state) override;

 private:
  std::shared_ptr<dch::Executor> executor;
  dch::Exclusions noExclusions;
  std::optional<ClusterPairKeeper> keeper;
  std::optional<dch::BornSums> sums;
  const dch::ClusterPairs* pairs = nullptr;  ///< at the positions of now; null where those are not used
  std::vector<double> charges;
};

}  // namespace OpenMMDCH

#endif
