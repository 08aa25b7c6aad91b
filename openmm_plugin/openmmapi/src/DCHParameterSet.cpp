// SPDX-License-Identifier: MIT
#include "internal/DCHParameterSet.h"

#include <algorithm>
#include <cmath>
#include <openmm/OpenMMException.h>
#include <utility>

#include "internal/DCHNonbondedChecks.h"

namespace OpenMMDCH {
namespace {

[[noreturn]] void refuseNumber(const std::string& what, std::size_t before, int now) {
  throw OpenMM::OpenMMException("updateParametersInContext: The number of " + what + " has changed from " +
                                std::to_string(before) + " to " + std::to_string(now) +
                                "; reinitialize the Context");
}

/// OpenMM looks at these when a Context is made alone.
void checkIndex(const std::string& what, int index, std::size_t count) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return;
  throw OpenMM::OpenMMException("updateParametersInContext: Illegal " + what + " index for a" +
                                (what == "exception" ? "n " : " ") + what +
                                " parameter offset: " + std::to_string(index));
}

/// OpenMM lets NaN pass where parameters are updated, and NonbondedForce at first too. Compared with the
/// parameters of others it would be taken for equal.
void checkParticle(const DCHParameterSet::Particle& p, std::size_t i) {
  if (std::isfinite(p.charge) && std::isfinite(p.sigma + p.epsilon) && p.sigma >= 0 && p.epsilon >= 0) return;
  const std::string of = "particle " + std::to_string(i);
  checkFinite("charge", p.charge, of);
  checkNotNegative("sigma", p.sigma, of);
  checkNotNegative("epsilon", p.epsilon, of);
}

}  // namespace

DCHParameterSet::DCHParameterSet(const OpenMM::NonbondedForce& force) {
  baseParticles.resize(static_cast<std::size_t>(force.getNumParticles()));
  for (int k = 0; k < force.getNumExceptions(); ++k) {
    Exception e;
    force.getExceptionParameters(k, e.particle1, e.particle2, e.chargeProd, e.sigma, e.epsilon);
    baseExceptions.push_back(e);
  }
  take(force);
}

void DCHParameterSet::take(const OpenMM::NonbondedForce& force) {
  if (force.getNumParticles() != static_cast<int>(baseParticles.size()))
    refuseNumber("particles", baseParticles.size(), force.getNumParticles());
  if (force.getNumExceptions() != static_cast<int>(baseExceptions.size()))
    refuseNumber("exceptions", baseExceptions.size(), force.getNumExceptions());
  std::vector<Exception> exceptions(baseExceptions.size());
  for (std::size_t k = 0; k < exceptions.size(); ++k) {
    Exception& e = exceptions[k];
    const Exception& before = baseExceptions[k];
    force.getExceptionParameters(static_cast<int>(k), e.particle1, e.particle2, e.chargeProd, e.sigma,
                                 e.epsilon);
    if (std::minmax(e.particle1, e.particle2) != std::minmax(before.particle1, before.particle2))
      throw OpenMM::OpenMMException(
          "updateParametersInContext: exception " + std::to_string(k) + " was for particles " +
          std::to_string(before.particle1) + " and " + std::to_string(before.particle2) + " and is now for " +
          std::to_string(e.particle1) + " and " + std::to_string(e.particle2) + "; reinitialize the Context");
  }
  takeOffsets(force);  // the last that may throw
  baseExceptions = std::move(exceptions);
  for (std::size_t i = 0; i < baseParticles.size(); ++i) {
    Particle& p = baseParticles[i];
    force.getParticleParameters(static_cast<int>(i), p.charge, p.sigma, p.epsilon);
  }
  isCurrent = false;
}

void DCHParameterSet::takeOffsets(const OpenMM::NonbondedForce& force) {
  std::vector<Offset> ofParticles, ofExceptions;
  for (int k = 0; k < force.getNumParticleParameterOffsets(); ++k) {
    Offset o;
    force.getParticleParameterOffset(k, o.parameter, o.index, o.charge, o.sigma, o.epsilon);
    checkIndex("particle", o.index, baseParticles.size());
    ofParticles.push_back(std::move(o));
  }
  for (int k = 0; k < force.getNumExceptionParameterOffsets(); ++k) {
    Offset o;
    force.getExceptionParameterOffset(k, o.parameter, o.index, o.charge, o.sigma, o.epsilon);
    checkIndex("exception", o.index, baseExceptions.size());
    ofExceptions.push_back(std::move(o));
  }
  particleOffsets = std::move(ofParticles);
  exceptionOffsets = std::move(ofExceptions);
}

bool DCHParameterSet::follow(OpenMM::ContextImpl& context) {
  for (const auto& [name, value] : globals) isCurrent = isCurrent && context.getParameter(name) == value;
  if (isCurrent) return false;
  evaluate(context);
  isCurrent = true;
  return true;
}

void DCHParameterSet::evaluate(OpenMM::ContextImpl& context) {
  nowParticles = baseParticles;
  nowExceptions = baseExceptions;
  globals.clear();
  for (const Offset& o : particleOffsets) {
    const double value = globals[o.parameter] = context.getParameter(o.parameter);
    Particle& p = nowParticles[static_cast<std::size_t>(o.index)];
    p.charge += value * o.charge;
    p.sigma += value * o.sigma;
    p.epsilon += value * o.epsilon;
  }
  for (const Offset& o : exceptionOffsets) {
    const double value = globals[o.parameter] = context.getParameter(o.parameter);
    Exception& e = nowExceptions[static_cast<std::size_t>(o.index)];
    e.chargeProd += value * o.charge;
    e.sigma += value * o.sigma;
    e.epsilon += value * o.epsilon;
  }
  for (const Offset& o : particleOffsets) {
    const Particle& p = nowParticles[static_cast<std::size_t>(o.index)];
    const std::string of = "particle " + std::to_string(o.index) + " with its offsets";
    checkFinite("charge", p.charge, of);
    checkNotNegative("sigma", p.sigma, of);
    checkNotNegative("epsilon", p.epsilon, of);
  }
  for (const Offset& o : exceptionOffsets) {
    const Exception& e = nowExceptions[static_cast<std::size_t>(o.index)];
    const std::string of = "exception " + std::to_string(o.index) + " with its offsets";
    checkFinite("charge product", e.chargeProd, of);
    checkNotNegative("sigma", e.sigma, of);
    checkNotNegative("epsilon", e.epsilon, of);
  }
  for (std::size_t i = 0; i < nowParticles.size(); ++i) checkParticle(nowParticles[i], i);
  anyCharge =
      std::any_of(nowParticles.begin(), nowParticles.end(), [](const Particle& p) { return p.charge != 0; });
}

}  // namespace OpenMMDCH
