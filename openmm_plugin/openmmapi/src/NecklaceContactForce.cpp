// SPDX-License-Identifier: MIT
#include "NecklaceContactForce.h"

#include <openmm/OpenMMException.h>
#include <string>

#include "internal/NecklaceContactForceImpl.h"

using OpenMM::OpenMMException;

namespace OpenMMDCH {
namespace {

void checkLengths(const std::vector<int>& particles, const std::vector<double>& radii) {
  if (particles.size() != radii.size())
    throw OpenMMException("NecklaceContactForce: a chain of " + std::to_string(particles.size()) +
                          " particles has " + std::to_string(radii.size()) + " radii; give one for each");
}

void checkChain(int index, int count) {
  if (index < 0 || index >= count)
    throw OpenMMException("NecklaceContactForce: there is no chain " + std::to_string(index) + "; it has " +
                          std::to_string(count));
}

}  // namespace

NecklaceContactForce::NecklaceContactForce() { setName("NecklaceContactForce"); }

int NecklaceContactForce::getNumBeads() const {
  std::size_t beads = 0;
  for (const Chain& chain : chains) beads += chain.particles.size();
  return static_cast<int>(beads);
}

void NecklaceContactForce::setEnergyFunction(EnergyFunction function) {
  if (function != WCA && function != Harmonic && function != SoftCosine)
    throw OpenMMException("NecklaceContactForce: " + std::to_string(static_cast<int>(function)) +
                          " is no energy function; choose WCA (0), Harmonic (1) or SoftCosine (2)");
  energyFunction = function;
}

int NecklaceContactForce::addChain(const std::vector<int>& particles, const std::vector<double>& radii,
                                   bool closed) {
  checkLengths(particles, radii);
  chains.push_back({particles, radii, closed});
  return getNumChains() - 1;
}

void NecklaceContactForce::getChainParameters(int index, std::vector<int>& particles,
                                              std::vector<double>& radii, bool& closed) const {
  checkChain(index, getNumChains());
  const Chain& chain = chains[static_cast<std::size_t>(index)];
  particles = chain.particles;
  radii = chain.radii;
  closed = chain.closed;
}

void NecklaceContactForce::setChainParameters(int index, const std::vector<int>& particles,
                                              const std::vector<double>& radii, bool closed) {
  checkChain(index, getNumChains());
  checkLengths(particles, radii);
  chains[static_cast<std::size_t>(index)] = {particles, radii, closed};
}

void NecklaceContactForce::updateParametersInContext(OpenMM::Context& context) {
  dynamic_cast<NecklaceContactForceImpl&>(getImplInContext(context))
      .updateParametersInContext(getContextImpl(context));
}

std::vector<NecklaceContact> NecklaceContactForce::getContacts(OpenMM::Context& context, double maxGap) {
  return dynamic_cast<NecklaceContactForceImpl&>(getImplInContext(context))
      .getContacts(getContextImpl(context), maxGap);
}

std::string NecklaceContactForce::getSearchInContext(const OpenMM::Context& context) const {
  return dynamic_cast<const NecklaceContactForceImpl&>(getImplInContext(context)).getSearch();
}

OpenMM::ForceImpl* NecklaceContactForce::createImpl() const { return new NecklaceContactForceImpl(*this); }

}  // namespace OpenMMDCH
