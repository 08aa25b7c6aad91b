// SPDX-License-Identifier: MIT
#include "NecklaceContactKernel.h"

#include <algorithm>
#include <cmath>
#include <openmm/OpenMMException.h>
#include <string>
#include <utility>

#include <dch/base/error.hpp>

#include "internal/DCHNonbondedChecks.h"

using dch::necklace::Chains;
using dch::necklace::Necklace;
using OpenMM::OpenMMException;

namespace OpenMMDCH {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw OpenMMException("NecklaceContactForce: " + what); }

Necklace necklaceOf(const OpenMM::System& system, const NecklaceContactForce& force) {
  const auto particles = static_cast<std::size_t>(system.getNumParticles());
  Chains chains(particles);
  std::vector<double> radii(particles);  // 0 for particles in no chain, which are not looked at
  std::vector<int> beads;
  std::vector<double> radiiOfBeads;
  bool closed;
  for (int index = 0; index < force.getNumChains(); ++index) {
    force.getChainParameters(index, beads, radiiOfBeads, closed);
    chains.add(beads, closed);
    for (std::size_t k = 0; k < beads.size(); ++k)
      radii[static_cast<std::size_t>(beads[k])] = radiiOfBeads[k];
  }
  return {std::move(chains), std::move(radii)};
}

/// @throws OpenMMException unless both are the same chains.
void checkSame(const Chains& before, const Chains& now) {
  if (now.size() != before.size())
    refuse("the number of chains has changed from " + std::to_string(before.size()) + " to " +
           std::to_string(now.size()) + "; reinitialize the Context");
  for (std::size_t index = 0; index < now.size(); ++index) {
    const auto a = before.beads(index), b = now.beads(index);
    if (before.closed(index) != now.closed(index) || !std::equal(a.begin(), a.end(), b.begin(), b.end()))
      refuse("chain " + std::to_string(index) +
             " has other particles than before, or has been opened or closed; reinitialize the Context");
  }
}

template <class F>
auto withHostErrors(const F& f) {
  try {
    return f();
  } catch (const dch::Error& e) {
    refuse(e.what());
  }
}

}  // namespace

void NecklaceContactKernel::initialize(const OpenMM::System& system, const NecklaceContactForce& force) {
  isPeriodic = force.usesPeriodicBoundaryConditions();
  query.skip_bonds = force.getExcludedBonds();
  query.within_chains = force.getActsWithinChains();
  query.between_chains = force.getActsBetweenChains();
  potential.emplace(force);
  withHostErrors([&] { keeper.emplace(necklaceOf(system, force), query, executor.get()); });
  if (!isPeriodic) return;
  OpenMM::Vec3 vectors[3];
  system.getDefaultPeriodicBoxVectors(vectors[0], vectors[1], vectors[2]);
  checkBox(boxOf(vectors));
}

void NecklaceContactKernel::copyParametersToContext(OpenMM::ContextImpl& context,
                                                    const NecklaceContactForce& force) {
  Necklace necklace = withHostErrors([&] { return necklaceOf(context.getSystem(), force); });
  checkSame(keeper->necklace().chains(), necklace.chains());
  keeper.emplace(std::move(necklace), query, executor.get());
  potential->setStrength(force.getStrength());
}

void NecklaceContactKernel::checkBox(const dch::Box& box) const {
  const double reach = 2 * keeper->necklace().largest_radius();
  if (reach > box.max_cutoff())
    refuse("twice the largest radius is " + textOf(reach) +
           " nm, which exceeds half of the smallest height of the periodic box, " + textOf(box.max_cutoff()) +
           " nm; take a larger box or smaller radii");
}

HostState NecklaceContactKernel::stateOf(OpenMM::ContextImpl& context) const {
  const HostState state = hostStateOf(context, isPeriodic);
  checkBox(state.box);
  return state;
}

double NecklaceContactKernel::execute(OpenMM::ContextImpl& context, bool, bool) {
  return withHostErrors([&] { return addPairs(stateOf(context)); });
}

double NecklaceContactKernel::addPairs(const HostState& state) {
  const auto radii = keeper->necklace().radii();
  double energy = 0;
  for (const auto& [first, second] : keeper->at(state.positions, state.box)) {
    const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
    const dch::Vec3 apart = state.box.nearest_image(state.positions[j] - state.positions[i]);
    const PairTerms terms = potential->ofBeads(norm2(apart), radii[i] + radii[j]);
    if (!(std::isfinite(terms.energy) && std::isfinite(terms.forceOverR)))
      refuse(
          "particles " + std::to_string(first) + " and " + std::to_string(second) + " are " +
          textOf(std::sqrt(norm2(apart))) +
          " nm apart, where WCA has no finite energy; move them apart, or begin with Harmonic or SoftCosine");
    const dch::Vec3 force = terms.forceOverR * apart;
    state.forces[i] = state.forces[i] - force;
    state.forces[j] = state.forces[j] + force;
    energy += terms.energy;
  }
  return energy;
}

std::vector<NecklaceContact> NecklaceContactKernel::contacts(OpenMM::ContextImpl& context, double maxGap) {
  return withHostErrors([&] {
    const HostState state = stateOf(context);
    std::vector<NecklaceContact> result;
    for (const auto& contact : keeper->contacts(state.positions, state.box, maxGap))
      result.push_back({contact.i, contact.j, contact.gap});
    return result;
  });
}

std::string NecklaceContactKernel::search() const {
  return name_of(keeper->choice().structure) + ": " + keeper->choice().reason;
}

}  // namespace OpenMMDCH
