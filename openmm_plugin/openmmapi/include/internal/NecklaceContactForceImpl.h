// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NECKLACE_CONTACT_FORCE_IMPL_H_
#define OPENMM_DCH_NECKLACE_CONTACT_FORCE_IMPL_H_

#include <map>
#include <openmm/Kernel.h>
#include <openmm/internal/ForceImpl.h>
#include <string>
#include <vector>

#include "NecklaceContactForce.h"

namespace OpenMMDCH {

/// A NecklaceContactForce in a Context: checks it and hands it to the kernel of the platform.
class NecklaceContactForceImpl : public OpenMM::ForceImpl {
 public:
  explicit NecklaceContactForceImpl(const NecklaceContactForce& force) : owner(force) {}
  void initialize(OpenMM::ContextImpl& context) override;
  const NecklaceContactForce& getOwner() const override { return owner; }
  void updateContextState(OpenMM::ContextImpl& context, bool& forcesInvalid) override;
  double calcForcesAndEnergy(OpenMM::ContextImpl& context, bool includeForces, bool includeEnergy,
                             int groups) override;
  std::map<std::string, double> getDefaultParameters() override { return {}; }
  std::vector<std::string> getKernelNames() override;
  void updateParametersInContext(OpenMM::ContextImpl& context);
  std::vector<NecklaceContact> getContacts(OpenMM::ContextImpl& context, double maxGap);
  std::string getSearch() const;

 private:
  const NecklaceContactForce& owner;
  OpenMM::Kernel kernel;
};

}  // namespace OpenMMDCH

#endif
