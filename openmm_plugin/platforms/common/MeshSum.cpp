// SPDX-License-Identifier: MIT
#include "MeshSum.h"

#include <algorithm>
#include <openmm/internal/NonbondedForceImpl.h>

namespace OpenMMDCH {

void MeshSum::initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force) {
  OpenMM::NonbondedForceImpl::calcPMEParameters(system, force, alpha, grid[0], grid[1], grid[2],
                                                isOfDispersion());
  start(system.getNumParticles());
}

void MeshSum::initialize(const std::array<int, 3>& chosenGrid, double chosenSplitting, int particles) {
  std::copy(chosenGrid.begin(), chosenGrid.end(), grid);
  alpha = chosenSplitting;
  start(particles);
}

}  // namespace OpenMMDCH
