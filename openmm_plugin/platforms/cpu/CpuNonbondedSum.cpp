// SPDX-License-Identifier: MIT
#include "CpuNonbondedSum.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace OpenMMDCH {
namespace {

// Kinds of particles whose pairs the kernels can keep in registers. With more, parameters are mixed pair by
// pair: as fast whatever their number.
constexpr std::size_t kMaxKinds = 4;

}  // namespace

void CpuNonbondedSum::initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force,
                                 const Splittings& splittings) {
  NonbondedSum::initialize(system, force, splittings);
  if (potential().hasCutoff()) keeper.emplace(potential().cutoffDistance(), exclusions(), executor);
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
  forcesOfAllPairs->set_executor(&executor);
}

void CpuNonbondedSum::makeForces() {
  const auto& particles = parameters().particles();
  const double cutoff = potential().cutoffDistance();
  std::map<std::pair<double, double>, std::int32_t> kinds;  // sigma and epsilon
  std::vector<std::int32_t> kindOf;
  std::vector<dch::LennardJonesParticle> parametersOf;
  for (const auto& p : particles) {
    const std::pair<double, double> kind(p.epsilon > 0 ? p.sigma : 0, p.epsilon);
    kindOf.push_back(kinds.try_emplace(kind, static_cast<std::int32_t>(kinds.size())).first->second);
    parametersOf.push_back({p.epsilon, p.sigma});
  }
  std::size_t side = kinds.size();
  if (side <= kMaxKinds) {
    std::vector<dch::LennardJonesPair> matrix(side * side);
    for (const auto& [a, kindA] : kinds)
      for (const auto& [b, kindB] : kinds)
        matrix[static_cast<std::size_t>(kindA) * side + static_cast<std::size_t>(kindB)] = {
            std::sqrt(a.second * b.second), 0.5 * (a.first + b.first), cutoff};
    forces.emplace(static_cast<int>(side), matrix, potential().hasDispersionSum());
  } else {
    forces.emplace(cutoff, parametersOf);
    side = 1;
    kindOf.clear();
  }
  forces->set_executor(&executor);
  keeper->setTypes(std::move(kindOf), static_cast<int>(side));
  setCharges(side * side);
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
  const dch::ClusterPairs& pairs = keeper->at(state.positions, state.box);
  const auto precision =
      forces->fits_single() && !isDouble ? dch::ForcePrecision::mixed : dch::ForcePrecision::double_precision;
  if (!includeEnergy) {
    forces->add_forces(pairs, precision, state.forces, charges);
    return 0;
  }
  const dch::LennardJonesSums sums = forces->add_forces_and_sum(pairs, precision, state.forces, charges);
  return sums.energy + sums.coulomb_energy;
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
  const auto threads = static_cast<std::size_t>(executor.threads());
  std::vector<double> energies(threads);
  forcesByThread.resize(threads);
  executor.run(executor.threads(), [&](int thread) {
    const auto k = static_cast<std::size_t>(thread);
    forcesByThread[k].assign(state.positions.size(), {});
    energies[k] = addRows(state, k, threads, forcesByThread[k]);
  });
  double energy = 0;
  for (std::size_t k = 0; k < threads; ++k) {
    energy += energies[k];
    for (std::size_t i = 0; i < state.forces.size(); ++i)
      state.forces[i] = state.forces[i] + forcesByThread[k][i];
  }
  return energy;
}

}  // namespace OpenMMDCH
