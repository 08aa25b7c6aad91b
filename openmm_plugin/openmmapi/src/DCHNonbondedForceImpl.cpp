// SPDX-License-Identifier: MIT
#include "internal/DCHNonbondedForceImpl.h"

#include <openmm/internal/ContextImpl.h>

#include "DCHKernels.h"
#include "internal/DCHNonbondedChecks.h"

namespace OpenMMDCH {

void DCHNonbondedForceImpl::initialize(OpenMM::ContextImpl& context) {
  checkForce(owner, context.getSystem());
  kernel = context.getPlatform().createKernel(CalcDCHNonbondedForceKernel::Name(), context);
  kernel.getAs<CalcDCHNonbondedForceKernel>().initialize(context.getSystem(), owner);
}

// The force does not change the state.
void DCHNonbondedForceImpl::updateContextState(OpenMM::ContextImpl&, bool&) {}

double DCHNonbondedForceImpl::calcForcesAndEnergy(OpenMM::ContextImpl& context, bool includeForces,
                                                  bool includeEnergy, int groups) {
  if ((groups & (1 << owner.getForceGroup())) == 0) return 0;
  return kernel.getAs<CalcDCHNonbondedForceKernel>().execute(context, includeForces, includeEnergy);
}

std::map<std::string, double> DCHNonbondedForceImpl::getDefaultParameters() {
  std::map<std::string, double> defaults;
  for (int i = 0; i < owner.getNumGlobalParameters(); ++i)
    defaults[owner.getGlobalParameterName(i)] = owner.getGlobalParameterDefaultValue(i);
  return defaults;
}

std::vector<std::string> DCHNonbondedForceImpl::getKernelNames() {
  return {CalcDCHNonbondedForceKernel::Name()};
}

void DCHNonbondedForceImpl::updateParametersInContext(OpenMM::ContextImpl& context) {
  checkForce(owner, context.getSystem());
  kernel.getAs<CalcDCHNonbondedForceKernel>().copyParametersToContext(context, owner);
  context.systemChanged();
}

}  // namespace OpenMMDCH
