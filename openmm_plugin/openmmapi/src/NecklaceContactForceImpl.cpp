// SPDX-License-Identifier: MIT
#include "internal/NecklaceContactForceImpl.h"

#include <openmm/internal/ContextImpl.h>

#include "DCHKernels.h"
#include "internal/NecklaceContactChecks.h"

namespace OpenMMDCH {

void NecklaceContactForceImpl::initialize(OpenMM::ContextImpl& context) {
  checkForce(owner, context.getSystem());
  kernel = context.getPlatform().createKernel(CalcNecklaceContactForceKernel::Name(), context);
  kernel.getAs<CalcNecklaceContactForceKernel>().initialize(context.getSystem(), owner);
}

// The force does not change the state.
void NecklaceContactForceImpl::updateContextState(OpenMM::ContextImpl&, bool&) {}

double NecklaceContactForceImpl::calcForcesAndEnergy(OpenMM::ContextImpl& context, bool includeForces,
                                                     bool includeEnergy, int groups) {
  if ((groups & (1 << owner.getForceGroup())) == 0) return 0;
  return kernel.getAs<CalcNecklaceContactForceKernel>().execute(context, includeForces, includeEnergy);
}

std::vector<std::string> NecklaceContactForceImpl::getKernelNames() {
  return {CalcNecklaceContactForceKernel::Name()};
}

void NecklaceContactForceImpl::updateParametersInContext(OpenMM::ContextImpl& context) {
  checkForce(owner, context.getSystem());
  kernel.getAs<CalcNecklaceContactForceKernel>().copyParametersToContext(context, owner);
  context.systemChanged();
}

std::vector<NecklaceContact> NecklaceContactForceImpl::getContacts(OpenMM::ContextImpl& context,
                                                                   double maxGap) {
  return kernel.getAs<CalcNecklaceContactForceKernel>().contacts(context, maxGap);
}

std::string NecklaceContactForceImpl::getSearch() const {
  return kernel.getAs<const CalcNecklaceContactForceKernel>().search();
}

}  // namespace OpenMMDCH
