// SPDX-License-Identifier: MIT
#include "MeshSum.h"

#include <openmm/internal/NonbondedForceImpl.h>

namespace OpenMMDCH {

void MeshSum::initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force) {
  OpenMM::NonbondedForceImpl::calcPMEParameters(system, force, alpha, grid[0], grid[1], grid[2],
                                                isOfDispersion());
  start(system.getNumParticles());
}

}  // namespace OpenMMDCH
