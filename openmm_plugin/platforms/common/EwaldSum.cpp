// SPDX-License-Identifier: MIT
#include "EwaldSum.h"

#include <openmm/internal/NonbondedForceImpl.h>

#include "HostErrors.h"
#include "HostState.h"
#include "PairPotential.h"

namespace OpenMMDCH {

void EwaldSum::initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force) {
  std::array<int, 3> count;
  OpenMM::NonbondedForceImpl::calcEwaldParameters(system, force, alpha, count[0], count[1], count[2]);
  withErrorsOfHost([&] { waves.emplace(count, alpha, PairPotential::coulombConstant()); });
  waves->set_executor(executor.get());
}

double EwaldSum::addWithThemselves(OpenMM::ContextImpl& context, const std::vector<double>& charges) {
  const HostState state = hostStateOf(context, true);
  return withErrorsOfHost(
      [&] { return waves->add_forces(state.positions, charges, state.box, state.forces); });
}

}  // namespace OpenMMDCH
