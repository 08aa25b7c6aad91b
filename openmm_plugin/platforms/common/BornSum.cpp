// SPDX-License-Identifier: MIT
#include "BornSum.h"

#include <cmath>
#include <openmm/OpenMMException.h>
#include <string>

#include <dch/engines/pair_search.hpp>

#include "HostErrors.h"
#include "internal/DCHNonbondedChecks.h"

namespace OpenMMDCH {
namespace {

constexpr double kSkinOfCutoff = 0.25;  // of the cutoff: as much as OpenMM pads its own lists

void checkPositions(dch::Span<const dch::Vec3> positions) {
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (!std::isfinite(norm2(positions[i])))
      throw OpenMM::OpenMMException("openmm_dch: the position of particle " + std::to_string(i) +
                                    " is not finite");
}

void addForce(const HostState& state, std::size_t i, std::size_t j, dch::Vec3 force) {
  state.forces[i] = state.forces[i] - force;
  state.forces[j] = state.forces[j] + force;
}

}  // namespace

double BornSum::add(OpenMM::ContextImpl& context, bool includeEnergy) {
  return withErrorsOfHost([&] {
    if (model.isPeriodic) checkBoxOfNow(boxVectorsOf(context), model.cutoff);
    const HostState state = hostStateOf(context, model.isPeriodic);
    follow(state);
    integrals.assign(model.particles.size(), 0);
    addIntegrals(state);
    double energy = addParticles();
    energy += addEnergies(state, includeEnergy);
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] *= radiusSlopes[i];
    addChain(state);
    return energy;
  });
}

double BornSum::addParticles() {
  const std::size_t count = model.particles.size();
  radii.resize(count);
  radiusSlopes.resize(count);
  slopes.resize(count);
  double energy = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const ValueAndSlope b = bornRadius(model, model.particles[i], integrals[i]);
    const ValueAndSlope own = energyOfParticle(model, model.particles[i], b.value);
    radii[i] = b.value;
    radiusSlopes[i] = b.slope;
    slopes[i] = own.slope;
    energy += own.value;
  }
  return energy;
}

/// A list whose skin fits the box: as large as there is room, or near it, since boxes change all the time
/// under a barostat.
void BornSum::chooseList(double room) {
  if (list && skin <= room && skin >= 0.5 * room) return;
  skin = room;
  dch::ListParams params;
  params.cutoffs = dch::TypeCutoffs(model.cutoff);
  params.skin = skin;
  list = std::make_unique<dch::VerletList>(dch::make_dch_search(params.list_radius()), params);
}

void BornSum::follow(const HostState& state) {
  const double room = roomForSkin(model.cutoff, kSkinOfCutoff, state.box);
  fits = room >= 0;
  if (!fits) return checkPositions(state.positions);
  chooseList(room);
  list->update(state.positions, state.box);
}

template <class Act>
void BornSum::forEachPair(const HostState& state, const Act& act) const {
  const double cutoff2 = model.cutoff * model.cutoff;
  const auto look = [&](std::size_t i, std::size_t j) {
    const dch::Vec3 apart = state.box.nearest_image(state.positions[j] - state.positions[i]);
    const double r2 = norm2(apart);
    if (r2 < cutoff2) act(i, j, apart, r2);
  };
  for (std::size_t i = 0; i < state.positions.size(); ++i)
    if (fits)
      for (const std::int32_t j : list->list().row(i)) look(i, static_cast<std::size_t>(j));
    else
      for (std::size_t j = i + 1; j < state.positions.size(); ++j) look(i, j);
}

void BornSum::addIntegrals(const HostState& state) {
  forEachPair(state, [&](std::size_t i, std::size_t j, const dch::Vec3&, double r2) {
    const double r = std::sqrt(r2);
    integrals[i] += integralOfPair(model, model.particles[i], model.particles[j], r).value;
    integrals[j] += integralOfPair(model, model.particles[j], model.particles[i], r).value;
  });
}

double BornSum::addEnergies(const HostState& state, bool) {
  double energy = 0;
  forEachPair(state, [&](std::size_t i, std::size_t j, const dch::Vec3& apart, double r2) {
    const double charges = model.particles[i].charge * model.particles[j].charge;
    const BornPairTerms terms = energyOfPair(model.energy, charges, radii[i] * radii[j], r2);
    energy += terms.energy;
    slopes[i] += terms.slope / radii[i];
    slopes[j] += terms.slope / radii[j];
    addForce(state, i, j, terms.forceOverR * apart);
  });
  return energy;
}

void BornSum::addChain(const HostState& state) {
  forEachPair(state, [&](std::size_t i, std::size_t j, const dch::Vec3& apart, double r2) {
    if (r2 == 0) return;
    const double r = std::sqrt(r2);
    const double slope = slopes[i] * integralOfPair(model, model.particles[i], model.particles[j], r).slope +
                         slopes[j] * integralOfPair(model, model.particles[j], model.particles[i], r).slope;
    addForce(state, i, j, -slope / r * apart);
  });
}

}  // namespace OpenMMDCH
