// SPDX-License-Identifier: MIT
#include "NecklaceContactForceProxy.h"

#include <memory>
#include <openmm/OpenMMException.h>
#include <openmm/serialization/SerializationNode.h>
#include <string>
#include <vector>

#include "NecklaceContactForce.h"

using OpenMM::SerializationNode;

namespace OpenMMDCH {
namespace {

constexpr int kContactVersion = 1;

void writeChain(const NecklaceContactForce& force, int index, SerializationNode& node) {
  std::vector<int> particles;
  std::vector<double> radii;
  bool closed;
  force.getChainParameters(index, particles, radii, closed);
  node.setBoolProperty("closed", closed);
  for (std::size_t k = 0; k < particles.size(); ++k)
    node.createChildNode("Bead").setIntProperty("p", particles[k]).setDoubleProperty("r", radii[k]);
}

void readChain(const SerializationNode& node, NecklaceContactForce& force) {
  std::vector<int> particles;
  std::vector<double> radii;
  for (const SerializationNode& bead : node.getChildren()) {
    particles.push_back(bead.getIntProperty("p"));
    radii.push_back(bead.getDoubleProperty("r"));
  }
  force.addChain(particles, radii, node.getBoolProperty("closed"));
}

}  // namespace

void NecklaceContactForceProxy::serialize(const void* object, SerializationNode& node) const {
  const auto& force = *static_cast<const NecklaceContactForce*>(object);
  node.setIntProperty("version", kContactVersion)
      .setIntProperty("forceGroup", force.getForceGroup())
      .setStringProperty("name", force.getName())
      .setIntProperty("energyFunction", force.getEnergyFunction())
      .setDoubleProperty("strength", force.getStrength())
      .setIntProperty("excludedBonds", force.getExcludedBonds())
      .setBoolProperty("withinChains", force.getActsWithinChains())
      .setBoolProperty("betweenChains", force.getActsBetweenChains())
      .setBoolProperty("usesPeriodic", force.usesPeriodicBoundaryConditions());
  SerializationNode& chains = node.createChildNode("Chains");
  for (int index = 0; index < force.getNumChains(); ++index)
    writeChain(force, index, chains.createChildNode("Chain"));
}

void* NecklaceContactForceProxy::deserialize(const SerializationNode& node) const {
  const int version = node.getIntProperty("version");
  if (version != kContactVersion)
    throw OpenMM::OpenMMException("NecklaceContactForce: serialized version " + std::to_string(version) +
                                  " is unknown; this library reads version " +
                                  std::to_string(kContactVersion));
  auto force = std::make_unique<NecklaceContactForce>();
  force->setForceGroup(node.getIntProperty("forceGroup"));
  force->setName(node.getStringProperty("name"));
  force->setEnergyFunction(
      static_cast<NecklaceContactForce::EnergyFunction>(node.getIntProperty("energyFunction")));
  force->setStrength(node.getDoubleProperty("strength"));
  force->setExcludedBonds(node.getIntProperty("excludedBonds"));
  force->setActsWithinChains(node.getBoolProperty("withinChains"));
  force->setActsBetweenChains(node.getBoolProperty("betweenChains"));
  force->setUsesPeriodicBoundaryConditions(node.getBoolProperty("usesPeriodic"));
  for (const SerializationNode& chain : node.getChildNode("Chains").getChildren()) readChain(chain, *force);
  return force.release();
}

}  // namespace OpenMMDCH
