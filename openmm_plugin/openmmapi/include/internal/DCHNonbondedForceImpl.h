// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NONBONDED_FORCE_IMPL_H_
#define OPENMM_DCH_NONBONDED_FORCE_IMPL_H_

#include <map>
#include <openmm/Kernel.h>
#include <openmm/internal/ForceImpl.h>
#include <string>
#include <vector>

#include "DCHNonbondedForce.h"

namespace OpenMMDCH {

/// A DCHNonbondedForce in a Context: checks it and hands it to the kernel of the platform.
class DCHNonbondedForceImpl : public OpenMM::ForceImpl {
 public:
  explicit DCHNonbondedForceImpl(const DCHNonbondedForce& force) : owner(force) {}
  void initialize(OpenMM::ContextImpl& context) override;
  const DCHNonbondedForce& getOwner() const override { return owner; }
  void updateContextState(OpenMM::ContextImpl& context, bool& forcesInvalid) override;
  double calcForcesAndEnergy(OpenMM::ContextImpl& context, bool includeForces, bool includeEnergy,
                             int groups) override;
  std::map<std::string, double> getDefaultParameters() override;
  std::vector<std::string> getKernelNames() override;
  void updateParametersInContext(OpenMM::ContextImpl& context);

 private:
  const DCHNonbondedForce& owner;
  OpenMM::Kernel kernel;
};

}  // namespace OpenMMDCH

#endif
