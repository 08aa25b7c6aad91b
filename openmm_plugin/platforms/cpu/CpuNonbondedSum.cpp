// SPDX-License-Identifier: MIT
#include "CpuNonbondedSum.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace OpenMMDCH {
namespace {

// Kinds of particles whose pairs the kernels can keep in registers. With more, parameters are mixed pair by
// pair: as fast whatever their number.
constexpr std::size_t kMaxKinds = 4;

struct Kinds {
  std::vector<dch::LennardJonesParticle> all;  ///< those without epsilon are one
  std::vector<std::int32_t> of;                ///< by particle
};

/// None of either if there are too many.
Kinds kindsOf(const std::vector<DCHParameterSet::Particle>& particles) {
  Kinds kinds;
  kinds.of.reserve(particles.size());
  for (const auto& p : particles) {
    const dch::LennardJonesParticle kind{p.epsilon, p.epsilon > 0 ? p.sigma : 0};
    const auto isIt = [&](const auto& k) { return k.epsilon == kind.epsilon && k.sigma == kind.sigma; };
    const auto found = std::find_if(kinds.all.begin(), kinds.all.end(), isIt);
    kinds.of.push_back(static_cast<std::int32_t>(found - kinds.all.begin()));
    if (found != kinds.all.end()) continue;
    if (kinds.all.size() == kMaxKinds) return {};
    kinds.all.push_back(kind);
  }
  return kinds;
}

}  // namespace

void CpuNonbondedSum::initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force,
                                 const Splittings& splittings) {
  NonbondedSum::initialize(system, force, splittings);
  if (potential().hasCutoff()) keeper.emplace(potential().cutoffDistance(), exclusions(), *threads());
}

void CpuNonbondedSum::parametersChanged() {
  if (keeper)
    makeForces();
  else if (!isDouble)
    makeForcesOfAllPairs();
}

void CpuNonbondedSum::makeForcesOfAllPairs() {
  std::vector<dch::LennardJonesParticle> particles;
  std::vector<double> chargesNow;
  for (const auto& p : parameters().particles()) {
    particles.push_back({p.epsilon, p.sigma});
    chargesNow.push_back(p.charge);
  }
  forcesOfAllPairs.emplace(particles, chargesNow, PairPotential::coulombConstant(), exclusions());
  forcesOfAllPairs->set_executor(threads());
}

void CpuNonbondedSum::makeForces() {
  const double cutoff = potential().cutoffDistance();
  Kinds kinds = kindsOf(parameters().particles());
  const std::size_t side = kinds.all.size();
  if (side > 0) {
    std::vector<dch::LennardJonesPair> matrix;
    for (const auto& a : kinds.all)
      for (const auto& b : kinds.all)
        matrix.push_back({std::sqrt(a.epsilon * b.epsilon), 0.5 * (a.sigma + b.sigma), cutoff});
    forces.emplace(static_cast<int>(side), matrix, potential().hasDispersionSum());
  } else {
    std::vector<dch::LennardJonesParticle> parametersOf;
    for (const auto& p : parameters().particles()) parametersOf.push_back({p.epsilon, p.sigma});
    forces.emplace(cutoff, parametersOf);
  }
  forces->set_executor(threads());
  forces->set_unresolved(&unresolved);
  const std::size_t types = std::max(side, std::size_t{1});
  keeper->setTypes(std::move(kinds.of), static_cast<int>(types));
  setCharges(types * types);
  if (potential().hasDispersionSum()) setDispersion();
  if (potential().isSwitched()) forces->set_switch(potential().switchingDistance());
}

void CpuNonbondedSum::setCharges(std::size_t typePairs) {
  charges.clear();
  if (!parameters().hasCharges() && !potential().hasDispersionSum()) return;
  for (const auto& p : parameters().particles()) charges.push_back(p.charge);
  forces->set_coulomb({PairPotential::coulombConstant(), potential().splitting(),
                       std::vector<double>(typePairs, potential().cutoffDistance()),
                       potential().reactionFieldK(), potential().reactionFieldC(), true});
}

void CpuNonbondedSum::setDispersion() {
  dch::DispersionTerm term{potential().dispersionSplitting(), {}};
  for (const auto& p : parameters().particles()) term.coefficients.push_back(PairPotential::dispersionOf(p));
  forces->set_dispersion(term);
}

double CpuNonbondedSum::addPairs(const HostState& state, bool includeEnergy) {
  if (!keeper) return addWithoutCutoff(state, includeEnergy);
  if (!keeper->fits(state.box)) return addAllPairs(state);
  const auto precision =
      forces->fits_single() && !isDouble ? dch::ForcePrecision::mixed : dch::ForcePrecision::double_precision;
  const dch::ClusterPairs& pairs =
      keeper->at(state.positions, state.box, dch::LennardJones::wanted_order(precision));
  dch::LennardJonesSums sums;
  if (includeEnergy)
    sums = forces->add_forces_and_sum(pairs, precision, state.forces, charges);
  else
    forces->add_forces(pairs, precision, state.forces, charges);
  if (!unresolved.empty()) return resolve(pairs, state, includeEnergy);
  return sums.energy + sums.coulomb_energy;
}

double CpuNonbondedSum::resolve(const dch::ClusterPairs& pairs, const HostState& state,
                                bool includeEnergy) const {
  std::vector<bool> isUnresolved(state.positions.size());
  for (const std::int32_t i : unresolved) isUnresolved[static_cast<std::size_t>(i)] = true;
  double energy = 0;
  pairs.for_each([&](std::int32_t first, std::int32_t second, const dch::Vec3& apart) {
    const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
    if (!includeEnergy && !isUnresolved[i] && !isUnresolved[j]) return;
    const auto& particles = parameters().particles();
    const PairTerms terms = potential().ofParticles(particles[i], particles[j], norm2(apart));
    const dch::Vec3 force = terms.forceOverR * apart;
    if (isUnresolved[i]) state.forces[i] = state.forces[i] - force;
    if (isUnresolved[j]) state.forces[j] = state.forces[j] + force;
    energy += terms.energy;
  });
  return energy;
}

double CpuNonbondedSum::addWithoutCutoff(const HostState& state, bool includeEnergy) {
  if (isDouble) return addAllPairs(state);
  found.assign(state.positions.size(), {});
  const double energy = forcesOfAllPairs->add_forces(state.positions, found, includeEnergy);
  const auto isFinite = [](const dch::Vec3& force) { return std::isfinite(norm2(force)); };
  if (!std::isfinite(energy) || !std::all_of(found.begin(), found.end(), isFinite)) return addAllPairs(state);
  for (std::size_t i = 0; i < found.size(); ++i) state.forces[i] = state.forces[i] + found[i];
  return energy;
}

double CpuNonbondedSum::addAllPairs(const HostState& state) {
  checkPositions(state.positions);
  const auto parts = static_cast<std::size_t>(threads()->threads());
  std::vector<double> energies(parts);
  forcesByThread.resize(parts);
  threads()->run(threads()->threads(), [&](int part) {
    const auto k = static_cast<std::size_t>(part);
    forcesByThread[k].assign(state.positions.size(), {});
    energies[k] = addRows(state, k, parts, forcesByThread[k]);
  });
  double energy = 0;
  for (std::size_t k = 0; k < parts; ++k) {
    energy += energies[k];
    for (std::size_t i = 0; i < state.forces.size(); ++i)
      state.forces[i] = state.forces[i] + forcesByThread[k][i];
  }
  return energy;
}

}  // namespace OpenMMDCH
