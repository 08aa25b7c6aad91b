// SPDX-License-Identifier: MIT
#include "DCHNonbondedKernelBase.h"

#include <algorithm>
#include <openmm/OpenMMException.h>
#include <openmm/internal/ContextImpl.h>
#include <openmm/internal/NonbondedForceImpl.h>
#include <vector>

#include <dch/base/error.hpp>

#include "internal/DCHNonbondedChecks.h"

namespace OpenMMDCH {
namespace {

double dispersionOf(const OpenMM::System& system, const DCHNonbondedForce& force) {
  const bool wanted =
      force.getNonbondedMethod() == DCHNonbondedForce::CutoffPeriodic && force.getUseDispersionCorrection();
  return wanted ? OpenMM::NonbondedForceImpl::calcDispersionCorrection(system, force.getParameters()) : 0;
}

}  // namespace

void DCHNonbondedKernelBase::initialize(const OpenMM::System& system, const DCHNonbondedForce& force) {
  isPeriodic = force.usesPeriodicBoundaryConditions();
  exceptionsArePeriodic = isPeriodic && force.getExceptionsUsePeriodicBoundaryConditions();
  parameterSet.emplace(force);
  pairPotential.emplace(force);
  std::vector<dch::IndexPair> pairs;
  for (int k = 0; k < force.getNumExceptions(); ++k) {
    int i, j;
    double chargeProd, sigma, epsilon;
    force.getExceptionParameters(k, i, j, chargeProd, sigma, epsilon);
    pairs.push_back({i, j});
  }
  excludedPairs = dch::Exclusions::from_pairs(static_cast<std::size_t>(force.getNumParticles()), pairs);
  dispersionCoefficient = dispersionOf(system, force);
}

void DCHNonbondedKernelBase::copyParametersToContext(OpenMM::ContextImpl& context,
                                                     const DCHNonbondedForce& force) {
  parameterSet->take(force);
  dispersionCoefficient = dispersionOf(context.getSystem(), force);
}

HostState DCHNonbondedKernelBase::stateOf(OpenMM::ContextImpl& context) const {
  if (isPeriodic) checkBox(boxVectorsOf(context), potential().cutoffDistance());
  return hostStateOf(context, isPeriodic);
}

double DCHNonbondedKernelBase::execute(OpenMM::ContextImpl& context, bool, bool includeEnergy) {
  try {
    if (parameterSet->follow(context)) parametersChanged();
    const HostState state = stateOf(context);
    double energy = addPairs(context, state, includeEnergy);
    energy += addExceptions(state);
    if (dispersionCoefficient != 0) energy += dispersionCoefficient / state.box.volume();
    return energy;
  } catch (const dch::Error& e) {
    throw OpenMM::OpenMMException(std::string("DCHNonbondedForce: ") + e.what());
  }
}

double DCHNonbondedKernelBase::addPair(const HostState& state, std::size_t i, std::size_t j,
                                       dch::Span<dch::Vec3> forces) const {
  const dch::Vec3 apart = state.box.nearest_image(state.positions[j] - state.positions[i]);
  const PairTerms terms =
      potential().ofParticles(parameters().particles()[i], parameters().particles()[j], norm2(apart));
  const dch::Vec3 force = terms.forceOverR * apart;
  forces[i] = forces[i] - force;
  forces[j] = forces[j] + force;
  return terms.energy;
}

double DCHNonbondedKernelBase::addRows(const HostState& state, std::size_t first, std::size_t stride,
                                       dch::Span<dch::Vec3> forces) const {
  double energy = 0;
  for (std::size_t i = first; i < state.positions.size(); i += stride) {
    const auto excluded = exclusions().partners(static_cast<std::int32_t>(i));
    const auto* next = std::upper_bound(excluded.begin(), excluded.end(), static_cast<std::int32_t>(i));
    for (std::size_t j = i + 1; j < state.positions.size(); ++j) {
      if (next != excluded.end() && static_cast<std::size_t>(*next) == j) {
        ++next;
        continue;
      }
      energy += addPair(state, i, j, forces);
    }
  }
  return energy;
}

double DCHNonbondedKernelBase::addExceptions(const HostState& state) const {
  double energy = 0;
  for (const DCHParameterSet::Exception& exception : parameters().exceptions()) {
    if (!exception.acts()) continue;
    const auto i = static_cast<std::size_t>(exception.particle1);
    const auto j = static_cast<std::size_t>(exception.particle2);
    dch::Vec3 apart = state.positions[j] - state.positions[i];
    if (exceptionsArePeriodic) apart = state.box.nearest_image(apart);
    const PairTerms terms = PairPotential::ofException(exception, norm2(apart));
    const dch::Vec3 force = terms.forceOverR * apart;
    state.forces[i] = state.forces[i] - force;
    state.forces[j] = state.forces[j] + force;
    energy += terms.energy;
  }
  return energy;
}

}  // namespace OpenMMDCH
