// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NECKLACE_CONTACT_KERNEL_H_
#define OPENMM_DCH_NECKLACE_CONTACT_KERNEL_H_

#include <optional>
#include <vector>

#include "ContactKeeper.h"
#include "ContactPotential.h"
#include "DCHKernels.h"
#include "HostState.h"

namespace OpenMMDCH {

/// A NecklaceContactForce on platforms on the processor, all in double and on one thread.
class NecklaceContactKernel : public CalcNecklaceContactForceKernel {
 public:
  using CalcNecklaceContactForceKernel::CalcNecklaceContactForceKernel;

  void initialize(const OpenMM::System& system, const NecklaceContactForce& force) override;
  double execute(OpenMM::ContextImpl& context, bool includeForces, bool includeEnergy) override;
  void copyParametersToContext(OpenMM::ContextImpl& context, const NecklaceContactForce& force) override;
  std::vector<NecklaceContact> contacts(OpenMM::ContextImpl& context, double maxGap) override;

 private:
  void checkBox(const dch::Box& box) const;
  HostState stateOf(OpenMM::ContextImpl& context) const;
  double addPairs(const HostState& state);

  bool isPeriodic = false;
  dch::necklace::ContactQuery query;
  std::optional<ContactKeeper> keeper;
  std::optional<ContactPotential> potential;
};

}  // namespace OpenMMDCH

#endif
