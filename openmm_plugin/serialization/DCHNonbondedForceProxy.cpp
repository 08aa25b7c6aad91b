// SPDX-License-Identifier: MIT
#include "DCHNonbondedForceProxy.h"

#include <memory>
#include <openmm/OpenMMException.h>
#include <openmm/serialization/SerializationNode.h>
#include <string>

#include "DCHNonbondedForce.h"

using OpenMM::SerializationNode;

namespace OpenMMDCH {
namespace {

constexpr int kNonbondedVersion = 1;

void writeParticles(const DCHNonbondedForce& force, SerializationNode& node) {
  double charge, sigma, epsilon;
  for (int k = 0; k < force.getNumParticles(); ++k) {
    force.getParticleParameters(k, charge, sigma, epsilon);
    node.createChildNode("Particle")
        .setDoubleProperty("q", charge)
        .setDoubleProperty("sig", sigma)
        .setDoubleProperty("eps", epsilon);
  }
}

void writeExceptions(const DCHNonbondedForce& force, SerializationNode& node) {
  int i, j;
  double chargeProd, sigma, epsilon;
  for (int k = 0; k < force.getNumExceptions(); ++k) {
    force.getExceptionParameters(k, i, j, chargeProd, sigma, epsilon);
    node.createChildNode("Exception")
        .setIntProperty("p1", i)
        .setIntProperty("p2", j)
        .setDoubleProperty("q", chargeProd)
        .setDoubleProperty("sig", sigma)
        .setDoubleProperty("eps", epsilon);
  }
}

void writeOffset(const std::string& parameter, const std::string& of, int index, double charge, double sigma,
                 double epsilon, SerializationNode& node) {
  node.createChildNode("Offset")
      .setStringProperty("parameter", parameter)
      .setIntProperty(of, index)
      .setDoubleProperty("q", charge)
      .setDoubleProperty("sig", sigma)
      .setDoubleProperty("eps", epsilon);
}

void writeOffsets(const DCHNonbondedForce& force, SerializationNode& node) {
  SerializationNode& globals = node.createChildNode("GlobalParameters");
  for (int k = 0; k < force.getNumGlobalParameters(); ++k)
    globals.createChildNode("Parameter")
        .setStringProperty("name", force.getGlobalParameterName(k))
        .setDoubleProperty("default", force.getGlobalParameterDefaultValue(k));
  std::string parameter;
  int index;
  double charge, sigma, epsilon;
  SerializationNode& ofParticles = node.createChildNode("ParticleOffsets");
  for (int k = 0; k < force.getNumParticleParameterOffsets(); ++k) {
    force.getParticleParameterOffset(k, parameter, index, charge, sigma, epsilon);
    writeOffset(parameter, "particle", index, charge, sigma, epsilon, ofParticles);
  }
  SerializationNode& ofExceptions = node.createChildNode("ExceptionOffsets");
  for (int k = 0; k < force.getNumExceptionParameterOffsets(); ++k) {
    force.getExceptionParameterOffset(k, parameter, index, charge, sigma, epsilon);
    writeOffset(parameter, "exception", index, charge, sigma, epsilon, ofExceptions);
  }
}

void readTerms(const SerializationNode& node, DCHNonbondedForce& force) {
  for (const SerializationNode& p : node.getChildNode("Particles").getChildren())
    force.addParticle(p.getDoubleProperty("q"), p.getDoubleProperty("sig"), p.getDoubleProperty("eps"));
  for (const SerializationNode& e : node.getChildNode("Exceptions").getChildren())
    force.addException(e.getIntProperty("p1"), e.getIntProperty("p2"), e.getDoubleProperty("q"),
                       e.getDoubleProperty("sig"), e.getDoubleProperty("eps"));
  for (const SerializationNode& g : node.getChildNode("GlobalParameters").getChildren())
    force.addGlobalParameter(g.getStringProperty("name"), g.getDoubleProperty("default"));
  for (const SerializationNode& o : node.getChildNode("ParticleOffsets").getChildren())
    force.addParticleParameterOffset(o.getStringProperty("parameter"), o.getIntProperty("particle"),
                                     o.getDoubleProperty("q"), o.getDoubleProperty("sig"),
                                     o.getDoubleProperty("eps"));
  for (const SerializationNode& o : node.getChildNode("ExceptionOffsets").getChildren())
    force.addExceptionParameterOffset(o.getStringProperty("parameter"), o.getIntProperty("exception"),
                                      o.getDoubleProperty("q"), o.getDoubleProperty("sig"),
                                      o.getDoubleProperty("eps"));
}

}  // namespace

void DCHNonbondedForceProxy::serialize(const void* object, SerializationNode& node) const {
  const auto& force = *static_cast<const DCHNonbondedForce*>(object);
  node.setIntProperty("version", kNonbondedVersion)
      .setIntProperty("forceGroup", force.getForceGroup())
      .setStringProperty("name", force.getName())
      .setIntProperty("method", force.getNonbondedMethod())
      .setDoubleProperty("cutoff", force.getCutoffDistance())
      .setBoolProperty("useSwitchingFunction", force.getUseSwitchingFunction())
      .setDoubleProperty("switchingDistance", force.getSwitchingDistance())
      .setDoubleProperty("rfDielectric", force.getReactionFieldDielectric())
      .setBoolProperty("dispersionCorrection", force.getUseDispersionCorrection())
      .setBoolProperty("exceptionsUsePeriodic", force.getExceptionsUsePeriodicBoundaryConditions());
  writeOffsets(force, node);
  writeParticles(force, node.createChildNode("Particles"));
  writeExceptions(force, node.createChildNode("Exceptions"));
}

void* DCHNonbondedForceProxy::deserialize(const SerializationNode& node) const {
  const int version = node.getIntProperty("version");
  if (version != kNonbondedVersion)
    throw OpenMM::OpenMMException("DCHNonbondedForce: serialized version " + std::to_string(version) +
                                  " is unknown; this library reads version " +
                                  std::to_string(kNonbondedVersion));
  auto force = std::make_unique<DCHNonbondedForce>();
  force->setForceGroup(node.getIntProperty("forceGroup"));
  force->setName(node.getStringProperty("name"));
  force->setNonbondedMethod(static_cast<DCHNonbondedForce::NonbondedMethod>(node.getIntProperty("method")));
  force->setCutoffDistance(node.getDoubleProperty("cutoff"));
  force->setUseSwitchingFunction(node.getBoolProperty("useSwitchingFunction"));
  force->setSwitchingDistance(node.getDoubleProperty("switchingDistance"));
  force->setReactionFieldDielectric(node.getDoubleProperty("rfDielectric"));
  force->setUseDispersionCorrection(node.getBoolProperty("dispersionCorrection"));
  force->setExceptionsUsePeriodicBoundaryConditions(node.getBoolProperty("exceptionsUsePeriodic"));
  readTerms(node, *force);
  return force.release();
}

}  // namespace OpenMMDCH
