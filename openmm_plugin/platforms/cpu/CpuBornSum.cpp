// SPDX-License-Identifier: MIT
#include "CpuBornSum.h"

#include <utility>

#include "HostErrors.h"

namespace OpenMMDCH {

void CpuBornSum::take(const BornModel& taken) {
  BornSum::take(taken);
  std::vector<dch::BornParticle> particles;
  dch::BornNecks necks = model.necks;
  charges.clear();
  for (const BornModel::Particle& p : model.particles) {
    particles.push_back({p.offsetRadius, p.scaledRadius});
    necks.kind.push_back(p.kind);
    charges.push_back(p.charge);
  }
  withErrorsOfHost([&] {
    sums.emplace(model.cutoff, particles, model.countsInside);
    if (necks.kinds > 0) sums->set_necks(std::move(necks));
  });
  sums->set_executor(executor.get());
  if (keeper) return;
  noExclusions = dch::Exclusions::from_pairs(particles.size(), std::vector<dch::IndexPair>{});
  keeper.emplace(model.cutoff, noExclusions, *executor);
}

void CpuBornSum::follow(const HostState& state) {
  pairs = nullptr;
  if (!sums->fits_single() || !keeper->fits(state.box)) return BornSum::follow(state);
  pairs = &keeper->at(state.positions, state.box);
}

void CpuBornSum::addIntegrals(const HostState& state) {
  if (!pairs) return BornSum::addIntegrals(state);
  sums->add_integrals(*pairs, integrals);
}

double CpuBornSum::addEnergies(const HostState& state, bool includeEnergy) {
  if (!pairs) return BornSum::addEnergies(state, includeEnergy);
  return sums->add_energies(*pairs, model.energy, charges, radii, state.forces, slopes, includeEnergy);
}

void CpuBornSum::addChain(const HostState& state) {
  if (!pairs) return BornSum::addChain(state);
  sums->add_chain(*pairs, slopes, state.forces);
}

}  // namespace OpenMMDCH
