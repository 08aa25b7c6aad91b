// SPDX-License-Identifier: MIT
#include "DCHNonbondedForce.h"

#include <openmm/OpenMMException.h>

#include "internal/DCHNonbondedForceImpl.h"

using OpenMM::NonbondedForce;
using OpenMM::OpenMMException;

namespace OpenMMDCH {
namespace {

void checkIndex(const std::string& what, int index, int count) {
  if (index >= 0 && index < count) return;
  throw OpenMMException("DCHNonbondedForce: there is no " + what + " " + std::to_string(index) + "; it has " +
                        std::to_string(count));
}

NonbondedForce::NonbondedMethod methodOf(DCHNonbondedForce::NonbondedMethod method) {
  switch (method) {
    case DCHNonbondedForce::NoCutoff:
      return NonbondedForce::NoCutoff;
    case DCHNonbondedForce::CutoffNonPeriodic:
      return NonbondedForce::CutoffNonPeriodic;
    case DCHNonbondedForce::CutoffPeriodic:
      return NonbondedForce::CutoffPeriodic;
  }
  throw OpenMMException("DCHNonbondedForce: " + std::to_string(static_cast<int>(method)) +
                        " is no nonbonded method; choose NoCutoff (0), CutoffNonPeriodic (1) or "
                        "CutoffPeriodic (2), or keep a NonbondedForce for Ewald, PME and LJPME");
}

}  // namespace

DCHNonbondedForce::DCHNonbondedForce() { setName("DCHNonbondedForce"); }

DCHNonbondedForce* DCHNonbondedForce::fromNonbonded(const NonbondedForce& force) {
  const char* const names[] = {"NoCutoff", "CutoffNonPeriodic", "CutoffPeriodic", "Ewald", "PME", "LJPME"};
  const int method = force.getNonbondedMethod();
  if (method > NonbondedForce::CutoffPeriodic)
    throw OpenMMException(std::string("DCHNonbondedForce: the nonbonded method ") + names[method] +
                          " is not available; keep the NonbondedForce");
  if (!force.getIncludeDirectSpace())
    throw OpenMMException(
        "DCHNonbondedForce: a force without its direct space part (setIncludeDirectSpace(false)) has no "
        "pairs to compute; keep the NonbondedForce");
  auto* const copy = new DCHNonbondedForce();
  copy->parameters = force;
  copy->setForceGroup(force.getForceGroup());
  if (force.getName() != NonbondedForce().getName()) copy->setName(force.getName());
  return copy;
}

DCHNonbondedForce::NonbondedMethod DCHNonbondedForce::getNonbondedMethod() const {
  return static_cast<NonbondedMethod>(parameters.getNonbondedMethod());
}

void DCHNonbondedForce::setNonbondedMethod(NonbondedMethod method) {
  parameters.setNonbondedMethod(methodOf(method));
}

int DCHNonbondedForce::addParticle(double charge, double sigma, double epsilon) {
  return parameters.addParticle(charge, sigma, epsilon);
}

void DCHNonbondedForce::getParticleParameters(int index, double& charge, double& sigma,
                                              double& epsilon) const {
  checkIndex("particle", index, getNumParticles());
  parameters.getParticleParameters(index, charge, sigma, epsilon);
}

void DCHNonbondedForce::setParticleParameters(int index, double charge, double sigma, double epsilon) {
  checkIndex("particle", index, getNumParticles());
  parameters.setParticleParameters(index, charge, sigma, epsilon);
}

int DCHNonbondedForce::addException(int particle1, int particle2, double chargeProd, double sigma,
                                    double epsilon, bool replace) {
  return parameters.addException(particle1, particle2, chargeProd, sigma, epsilon, replace);
}

void DCHNonbondedForce::getExceptionParameters(int index, int& particle1, int& particle2, double& chargeProd,
                                               double& sigma, double& epsilon) const {
  checkIndex("exception", index, getNumExceptions());
  parameters.getExceptionParameters(index, particle1, particle2, chargeProd, sigma, epsilon);
}

void DCHNonbondedForce::setExceptionParameters(int index, int particle1, int particle2, double chargeProd,
                                               double sigma, double epsilon) {
  checkIndex("exception", index, getNumExceptions());
  parameters.setExceptionParameters(index, particle1, particle2, chargeProd, sigma, epsilon);
}

void DCHNonbondedForce::createExceptionsFromBonds(const std::vector<std::pair<int, int> >& bonds,
                                                  double coulomb14Scale, double lj14Scale) {
  for (const auto& bond : bonds) {
    checkIndex("particle", bond.first, getNumParticles());
    checkIndex("particle", bond.second, getNumParticles());
  }
  parameters.createExceptionsFromBonds(bonds, coulomb14Scale, lj14Scale);
}

int DCHNonbondedForce::addGlobalParameter(const std::string& parameter, double defaultValue) {
  return parameters.addGlobalParameter(parameter, defaultValue);
}

const std::string& DCHNonbondedForce::getGlobalParameterName(int index) const {
  checkIndex("global parameter", index, getNumGlobalParameters());
  return parameters.getGlobalParameterName(index);
}

void DCHNonbondedForce::setGlobalParameterName(int index, const std::string& parameter) {
  checkIndex("global parameter", index, getNumGlobalParameters());
  parameters.setGlobalParameterName(index, parameter);
}

double DCHNonbondedForce::getGlobalParameterDefaultValue(int index) const {
  checkIndex("global parameter", index, getNumGlobalParameters());
  return parameters.getGlobalParameterDefaultValue(index);
}

void DCHNonbondedForce::setGlobalParameterDefaultValue(int index, double defaultValue) {
  checkIndex("global parameter", index, getNumGlobalParameters());
  parameters.setGlobalParameterDefaultValue(index, defaultValue);
}

int DCHNonbondedForce::addParticleParameterOffset(const std::string& parameter, int particleIndex,
                                                  double chargeScale, double sigmaScale,
                                                  double epsilonScale) {
  return parameters.addParticleParameterOffset(parameter, particleIndex, chargeScale, sigmaScale,
                                               epsilonScale);
}

void DCHNonbondedForce::getParticleParameterOffset(int index, std::string& parameter, int& particleIndex,
                                                   double& chargeScale, double& sigmaScale,
                                                   double& epsilonScale) const {
  checkIndex("particle parameter offset", index, getNumParticleParameterOffsets());
  parameters.getParticleParameterOffset(index, parameter, particleIndex, chargeScale, sigmaScale,
                                        epsilonScale);
}

void DCHNonbondedForce::setParticleParameterOffset(int index, const std::string& parameter, int particleIndex,
                                                   double chargeScale, double sigmaScale,
                                                   double epsilonScale) {
  checkIndex("particle parameter offset", index, getNumParticleParameterOffsets());
  parameters.setParticleParameterOffset(index, parameter, particleIndex, chargeScale, sigmaScale,
                                        epsilonScale);
}

int DCHNonbondedForce::addExceptionParameterOffset(const std::string& parameter, int exceptionIndex,
                                                   double chargeProdScale, double sigmaScale,
                                                   double epsilonScale) {
  return parameters.addExceptionParameterOffset(parameter, exceptionIndex, chargeProdScale, sigmaScale,
                                                epsilonScale);
}

void DCHNonbondedForce::getExceptionParameterOffset(int index, std::string& parameter, int& exceptionIndex,
                                                    double& chargeProdScale, double& sigmaScale,
                                                    double& epsilonScale) const {
  checkIndex("exception parameter offset", index, getNumExceptionParameterOffsets());
  parameters.getExceptionParameterOffset(index, parameter, exceptionIndex, chargeProdScale, sigmaScale,
                                         epsilonScale);
}

void DCHNonbondedForce::setExceptionParameterOffset(int index, const std::string& parameter,
                                                    int exceptionIndex, double chargeProdScale,
                                                    double sigmaScale, double epsilonScale) {
  checkIndex("exception parameter offset", index, getNumExceptionParameterOffsets());
  parameters.setExceptionParameterOffset(index, parameter, exceptionIndex, chargeProdScale, sigmaScale,
                                         epsilonScale);
}

void DCHNonbondedForce::updateParametersInContext(OpenMM::Context& context) {
  dynamic_cast<DCHNonbondedForceImpl&>(getImplInContext(context))
      .updateParametersInContext(getContextImpl(context));
}

OpenMM::ForceImpl* DCHNonbondedForce::createImpl() const { return new DCHNonbondedForceImpl(*this); }

}  // namespace OpenMMDCH
