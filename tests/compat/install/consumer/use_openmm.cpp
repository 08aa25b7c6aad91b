// SPDX-License-Identifier: MIT
#include <DCHNonbondedForce.h>
#include <NecklaceContactForce.h>
#include <cstdio>

int main() {
  OpenMMDCH::DCHNonbondedForce force;
  force.addParticle(0.5, 0.3, 1);
  const OpenMMDCH::NecklaceContactForce contacts;
  std::printf("%d particle, %d chains\n", force.getNumParticles(), contacts.getNumChains());
  return force.getNumParticles() == 1 && contacts.getNumChains() == 0 ? 0 : 1;
}
