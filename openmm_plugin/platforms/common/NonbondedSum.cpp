// SPDX-License-Identifier: MIT
#include "NonbondedSum.h"

#include <algorithm>
#include <cmath>
#include <openmm/OpenMMException.h>
#include <openmm/internal/NonbondedForceImpl.h>
#include <string>
#include <vector>

#include "HostErrors.h"
#include "internal/DCHNonbondedChecks.h"

namespace OpenMMDCH {
namespace {

double dispersionOf(const OpenMM::System& system, const OpenMM::NonbondedForce& force) {
  const bool wanted = force.usesPeriodicBoundaryConditions() && force.getUseDispersionCorrection() &&
                      force.getNonbondedMethod() != OpenMM::NonbondedForce::LJPME;
  return wanted ? OpenMM::NonbondedForceImpl::calcDispersionCorrection(system, force) : 0;
}

dch::Exclusions exclusionsOf(const OpenMM::NonbondedForce& force) {
  std::vector<dch::IndexPair> pairs;
  for (int k = 0; k < force.getNumExceptions(); ++k) {
    int i, j;
    double chargeProd, sigma, epsilon;
    force.getExceptionParameters(k, i, j, chargeProd, sigma, epsilon);
    pairs.push_back({i, j});
  }
  return dch::Exclusions::from_pairs(static_cast<std::size_t>(force.getNumParticles()), pairs);
}

}  // namespace

void NonbondedSum::initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force,
                              const Splittings& splittings) {
  isPeriodic = force.usesPeriodicBoundaryConditions();
  exceptionsArePeriodic = isPeriodic && force.getExceptionsUsePeriodicBoundaryConditions();
  parameterSet.emplace(force);
  pairPotential.emplace(force, splittings);
  excludedPairs = exclusionsOf(force);
  dispersionCoefficient = dispersionOf(system, force);
}

void NonbondedSum::copyParameters(const OpenMM::System& system, const OpenMM::NonbondedForce& force) {
  parameterSet->take(force);
  dispersionCoefficient = dispersionOf(system, force);
}

void NonbondedSum::follow(OpenMM::ContextImpl& context) {
  if (parameterSet->follow(context)) isFollowed = false;
  if (isFollowed) return;
  withErrorsOfHost([&] { parametersChanged(); });
  isFollowed = true;  // not where parameters were refused, which are refused the next time too
}

HostState NonbondedSum::stateOf(OpenMM::ContextImpl& context) const {
  if (isPeriodic) checkBoxOfNow(boxVectorsOf(context), potential().cutoffDistance());
  return hostStateOf(context, isPeriodic);
}

double NonbondedSum::add(OpenMM::ContextImpl& context, bool includeEnergy) {
  return withErrorsOfHost([&] {
    const HostState state = stateOf(context);
    double energy = addPairs(state, includeEnergy);
    energy += addExceptions(state);
    if (dispersionCoefficient != 0) energy += dispersionCoefficient / state.box.volume();
    return energy;
  });
}

double NonbondedSum::addPair(const HostState& state, std::size_t i, std::size_t j,
                             dch::Span<dch::Vec3> forces) const {
  const dch::Vec3 apart = state.box.nearest_image(state.positions[j] - state.positions[i]);
  const PairTerms terms =
      potential().ofParticles(parameters().particles()[i], parameters().particles()[j], norm2(apart));
  const dch::Vec3 force = terms.forceOverR * apart;
  forces[i] = forces[i] - force;
  forces[j] = forces[j] + force;
  return terms.energy;
}

double NonbondedSum::addRows(const HostState& state, std::size_t first, std::size_t stride,
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

void NonbondedSum::checkPositions(dch::Span<const dch::Vec3> positions) {
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (!std::isfinite(norm2(positions[i])))
      throw OpenMM::OpenMMException("openmm_dch: the position of particle " + std::to_string(i) +
                                    " is not finite");
}

/// Threads find the terms, which take exponentials, and one adds them in their order.
double NonbondedSum::addExceptions(const HostState& state) {
  const std::vector<DCHParameterSet::Exception>& exceptions = parameters().exceptions();
  exceptionTerms.resize(exceptions.size());
  dch::for_ranges(executor.get(), exceptions.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) exceptionTerms[k] = termsOf(state, exceptions[k]);
  });
  double energy = 0;
  for (std::size_t k = 0; k < exceptions.size(); ++k) {
    dch::Vec3& first = state.forces[static_cast<std::size_t>(exceptions[k].particle1)];
    dch::Vec3& second = state.forces[static_cast<std::size_t>(exceptions[k].particle2)];
    first = first - exceptionTerms[k].force;
    second = second + exceptionTerms[k].force;
    energy += exceptionTerms[k].energy;
  }
  return energy;
}

/// The sum in reciprocal space holds all pairs, so what it has of an excluded one is taken away here.
NonbondedSum::ExceptionTerms NonbondedSum::termsOf(const HostState& state,
                                                   const DCHParameterSet::Exception& exception) const {
  const auto i = static_cast<std::size_t>(exception.particle1);
  const auto j = static_cast<std::size_t>(exception.particle2);
  const DCHParameterSet::Particle &a = parameters().particles()[i], &b = parameters().particles()[j];
  const bool isInReciprocalSpace = potential().isInReciprocalSpace(a, b);
  if (!exception.acts() && !isInReciprocalSpace) return {};
  dch::Vec3 apart = state.positions[j] - state.positions[i];
  if (exceptionsArePeriodic) apart = state.box.nearest_image(apart);
  PairTerms terms;
  if (exception.acts()) terms = PairPotential::ofException(exception, norm2(apart));
  if (isInReciprocalSpace) terms = terms - potential().inReciprocalSpace(a, b, norm2(apart));
  return {terms.forceOverR * apart, terms.energy};
}

}  // namespace OpenMMDCH
