// SPDX-License-Identifier: MIT
#include "ReciprocalSum.h"

#include <cmath>
#include <openmm/internal/NonbondedForceImpl.h>

#include "PairPotential.h"

namespace OpenMMDCH {

void ReciprocalSum::initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force) {
  OpenMM::NonbondedForceImpl::calcPMEParameters(system, force, alpha, grid[0], grid[1], grid[2], false);
  start(system.getNumParticles());
}

double ReciprocalSum::add(OpenMM::ContextImpl& context,
                          const std::vector<DCHParameterSet::Particle>& particles) {
  chargesNow.clear();
  double squares = 0;
  for (const DCHParameterSet::Particle& p : particles) {
    chargesNow.push_back(p.charge);
    squares += p.charge * p.charge;
  }
  const double ofThemselves = PairPotential::coulombConstant() * alpha / std::sqrt(std::acos(-1.0)) * squares;
  return addMesh(context, chargesNow) - ofThemselves;
}

}  // namespace OpenMMDCH
