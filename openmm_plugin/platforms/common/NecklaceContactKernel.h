// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NECKLACE_CONTACT_KERNEL_H_
#define OPENMM_DCH_NECKLACE_CONTACT_KERNEL_H_

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/executor.hpp>

#include "ContactKeeper.h"
#include "ContactPotential.h"
#include "DCHKernels.h"
#include "HostState.h"

namespace OpenMMDCH {

/// A NecklaceContactForce on platforms on the processor, all in double. Contacts are searched on
/// several threads, forces are added on one.
class NecklaceContactKernel : public CalcNecklaceContactForceKernel {
 public:
  /// @param threads  null for one
  NecklaceContactKernel(const std::string& kernelName, const OpenMM::Platform& onPlatform,
                        std::shared_ptr<dch::Executor> threads = nullptr)
      : CalcNecklaceContactForceKernel(kernelName, onPlatform), executor(std::move(threads)) {}

  void initialize(const OpenMM::System& system, const NecklaceContactForce& force) override;
  double execute(OpenMM::ContextImpl& context, bool includeForces, bool includeEnergy) override;
  void copyParametersToContext(OpenMM::ContextImpl& context, const NecklaceContactForce& force) override;
  std::vector<NecklaceContact> contacts(OpenMM::ContextImpl& context, double maxGap) override;
  std::string search() const override;

 private:
  void checkBox(const dch::Box& box) const;
  HostState stateOf(OpenMM::ContextImpl& context) const;
  double addPairs(const HostState& state);

  std::shared_ptr<dch::Executor> executor;
  bool isPeriodic = false;
  dch::necklace::ContactQuery query;
  std::optional<ContactKeeper> keeper;
  std::optional<ContactPotential> potential;
};

}  // namespace OpenMMDCH

#endif
