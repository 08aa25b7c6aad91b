// SPDX-License-Identifier: MIT
#include "internal/NecklaceContactChecks.h"

#include <cmath>
#include <openmm/OpenMMException.h>
#include <string>

#include "internal/DCHNonbondedChecks.h"

namespace OpenMMDCH {
namespace {

constexpr int kNone = -1;

[[noreturn]] void refuseContacts(const std::string& what) {
  throw OpenMM::OpenMMException("NecklaceContactForce: " + what);
}

void checkSettings(const NecklaceContactForce& force) {
  const double strength = force.getStrength();
  if (!(std::isfinite(strength) && strength >= 0))
    refuseContacts("the strength is " + textOf(strength) + "; it must be finite and not negative");
  if (force.getExcludedBonds() < 0)
    refuseContacts("the number of excluded bonds is " + std::to_string(force.getExcludedBonds()) +
                   "; it must not be negative");
}

/// @param chainOf  by particle, which chain it stands in; takes in this one
void checkBead(int index, int bead, double radius, std::vector<int>& chainOf) {
  const std::string chain = "chain " + std::to_string(index);
  const std::string particle = "particle " + std::to_string(bead);
  if (bead < 0 || bead >= static_cast<int>(chainOf.size()))
    refuseContacts(chain + " names " + particle + "; the System has " + std::to_string(chainOf.size()));
  int& owner = chainOf[static_cast<std::size_t>(bead)];
  if (owner == index) refuseContacts(chain + " names " + particle + " twice");
  if (owner != kNone)
    refuseContacts("chains " + std::to_string(owner) + " and " + std::to_string(index) + " share " +
                   particle + "; a bead belongs to one chain");
  owner = index;
  if (!(std::isfinite(radius) && radius > 0))
    refuseContacts("the radius of " + particle + " in " + chain + " is " + textOf(radius) +
                   " nm; it must be finite and positive");
}

/// @param chainOf  as for checkBead()
void checkChain(const NecklaceContactForce& force, int index, std::vector<int>& chainOf) {
  std::vector<int> particles;
  std::vector<double> radii;
  bool closed;
  force.getChainParameters(index, particles, radii, closed);
  const std::string chain = "chain " + std::to_string(index);
  if (particles.empty()) refuseContacts(chain + " has 0 beads; it needs at least one");
  if (closed && particles.size() < 3)
    refuseContacts(chain + " is closed and has " + std::to_string(particles.size()) +
                   " beads; a closed chain needs at least 3");
  for (std::size_t k = 0; k < particles.size(); ++k) checkBead(index, particles[k], radii[k], chainOf);
}

}  // namespace

void checkForce(const NecklaceContactForce& force, const OpenMM::System& system) {
  checkSettings(force);
  std::vector<int> chainOf(static_cast<std::size_t>(system.getNumParticles()), kNone);
  for (int index = 0; index < force.getNumChains(); ++index) checkChain(force, index, chainOf);
}

}  // namespace OpenMMDCH
