// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "all_pairs_oracle.hpp"

namespace OpenMMDCH {

/// A System of random particles with an OpenMM NonbondedForce that uses all of its features.
struct RandomSystem {
  OpenMM::System system;
  OpenMM::NonbondedForce* force = new OpenMM::NonbondedForce();  // owned by the System
  std::vector<Vec3> positions;
  Vec3 box[3];
};

/// A reduced box whose widths are at least so many cutoffs of 1 nm.
inline void choose_box(RandomSystem& to, dch::scenes::Random& random) {
  const bool skewed = random.below(2) == 0;
  Vec3 width;
  for (int axis = 0; axis < 3; ++axis) width[axis] = random.uniform(2.05, 3.2);
  const auto tilt = [&](double of) { return skewed ? random.uniform(-0.49, 0.49) * of : 0.0; };
  to.box[0] = Vec3(width[0], 0, 0);
  to.box[1] = Vec3(tilt(width[0]), width[1], 0);
  to.box[2] = Vec3(tilt(width[0]), tilt(width[1]), width[2]);
  to.system.setDefaultPeriodicBoxVectors(to.box[0], to.box[1], to.box[2]);
}

/// Whether no image of q is too close to p, or so near the cutoff that it takes double precision to tell
/// whether the two interact.
inline bool fits_beside(const Vec3& p, const Vec3& q, const Vec3* box, double closest, double cutoff) {
  bool fits = true;
  for_each_image(p - q, box, [&](const Vec3& d) {
    const double r = std::sqrt(d.dot(d));
    fits = fits && r > closest && std::abs(r - cutoff) > 1e-5 * cutoff;
  });
  return fits;
}

inline void add_particles(RandomSystem& to, int count, int kinds, dch::scenes::Random& random) {
  for (int trial = 0; trial < 50 * count && static_cast<int>(to.positions.size()) < count; ++trial) {
    const Vec3 at =
        to.box[0] * random.uniform() + to.box[1] * random.uniform() + to.box[2] * random.uniform();
    bool fits = true;
    for (const Vec3& other : to.positions) fits = fits && fits_beside(at, other, to.box, 0.26, 1);
    if (!fits) continue;
    const int kind = static_cast<int>(to.positions.size()) % kinds;
    to.system.addParticle(1);
    to.force->addParticle(random.uniform(-0.8, 0.8), 0.28 + 0.01 * kind, kind == 1 ? 0.0 : 0.4 + 0.1 * kind);
    to.positions.push_back(at);
  }
}

/// Excluded pairs of particles near each other, some of which act by terms of their own; others go elsewhere.
inline void add_exceptions(RandomSystem& to, dch::scenes::Random& random) {
  const int count = static_cast<int>(to.positions.size());
  const auto at = [&](int i) -> Vec3& { return to.positions[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < count; i += 2)
    for (int j = i + 1; j < count; ++j) {
      const Vec3 apart = wrapped(at(j) - at(i), to.box);
      if (apart.dot(apart) > 0.5 * 0.5) continue;
      const bool acts = random.below(2) == 0;
      to.force->addException(i, j, acts ? random.uniform(-0.3, 0.3) : 0.0, 0.3, acts ? 0.2 : 0.0);
    }
  for (int i = 0; i < count; i += 3)
    for (const Vec3& vector : to.box) at(i) += vector * (static_cast<double>(random.below(5)) - 2);
}

inline void add_offsets(RandomSystem& to, dch::scenes::Random& random) {
  to.force->addGlobalParameter("lambda", random.uniform());
  for (int i = 0; i < to.force->getNumParticles(); i += 7)
    to.force->addParticleParameterOffset("lambda", i, random.uniform(-0.5, 0.5), 0.01, 0.2);
  if (to.force->getNumExceptions() > 0) to.force->addExceptionParameterOffset("lambda", 0, 0.2, 0.05, 0.3);
}

/// All features that a method has, each in about half of the Systems.
inline std::unique_ptr<RandomSystem> random_system(OpenMM::NonbondedForce::NonbondedMethod method,
                                                   std::uint64_t seed) {
  dch::scenes::Random random(seed);
  auto made = std::make_unique<RandomSystem>();
  choose_box(*made, random);
  add_particles(*made, 20 + static_cast<int>(random.below(120)), 1 + static_cast<int>(random.below(8)),
                random);
  OpenMM::NonbondedForce& force = *made->force;
  force.setNonbondedMethod(method);
  force.setCutoffDistance(1);
  force.setUseSwitchingFunction(random.below(2) == 0 && method != OpenMM::NonbondedForce::LJPME);
  force.setSwitchingDistance(random.uniform(0.5, 0.95));
  force.setUseDispersionCorrection(false);
  force.setExceptionsUsePeriodicBoundaryConditions(random.below(2) == 0);
  force.setReciprocalSpaceForceGroup(1);
  if (random.below(2) == 0) add_exceptions(*made, random);
  if (random.below(2) == 0) add_offsets(*made, random);
  made->system.addForce(made->force);
  return made;
}

/// The same force with its offsets added to its parameters, at the default values of the global ones.
inline OpenMM::NonbondedForce with_offsets_added(const OpenMM::NonbondedForce& force) {
  OpenMM::NonbondedForce added = force;
  for (int k = 0; k < force.getNumParticleParameterOffsets(); ++k) {
    std::string name;
    int i;
    double q, sigma, epsilon, dq, dsigma, depsilon;
    force.getParticleParameterOffset(k, name, i, dq, dsigma, depsilon);
    added.getParticleParameters(i, q, sigma, epsilon);
    const double value = force.getGlobalParameterDefaultValue(0);
    added.setParticleParameters(i, q + value * dq, sigma + value * dsigma, epsilon + value * depsilon);
  }
  for (int k = 0; k < force.getNumExceptionParameterOffsets(); ++k) {
    std::string name;
    int e, i, j;
    double qq, sigma, epsilon, dq, dsigma, depsilon;
    force.getExceptionParameterOffset(k, name, e, dq, dsigma, depsilon);
    added.getExceptionParameters(e, i, j, qq, sigma, epsilon);
    const double value = force.getGlobalParameterDefaultValue(0);
    added.setExceptionParameters(e, i, j, qq + value * dq, sigma + value * dsigma,
                                 epsilon + value * depsilon);
  }
  return added;
}

/// Rigid molecules of three charges, on a jittered lattice in a skewed box with heights of at least four
/// cutoffs.
inline std::unique_ptr<RandomSystem> make_water(int per_side) {
  auto water = std::make_unique<RandomSystem>();
  const double spacing = 0.33, edge = spacing * per_side;
  water->box[0] = Vec3(edge, 0, 0);
  water->box[1] = Vec3(0.2 * edge, edge, 0);
  water->box[2] = Vec3(-0.1 * edge, 0.15 * edge, edge);
  water->system.setDefaultPeriodicBoxVectors(water->box[0], water->box[1], water->box[2]);
  dch::scenes::Random random(5);
  for (int k = 0; k < per_side * per_side * per_side; ++k) {
    const Vec3 at = (water->box[0] * (k % per_side) + water->box[1] * (k / per_side % per_side) +
                     water->box[2] * (k / per_side / per_side)) *
                    (1.0 / per_side);
    for (int atom = 0; atom < 3; ++atom) {
      const Vec3 arm = atom == 0 ? Vec3() : random.vector<Vec3>(-0.5, 0.5);
      water->system.addParticle(atom == 0 ? 16 : 1);
      water->positions.push_back(atom == 0 ? at : at + arm * (0.1 / std::sqrt(arm.dot(arm))));
      water->force->addParticle(atom == 0 ? -0.8 : 0.4, atom == 0 ? 0.315 : 1, atom == 0 ? 0.64 : 0);
    }
    for (const auto& [i, j] : {std::pair(0, 1), {0, 2}, {1, 2}})
      water->force->addException(3 * k + i, 3 * k + j, 0, 1, 0);
  }
  water->force->setNonbondedMethod(OpenMM::NonbondedForce::PME);
  water->force->setPMEParameters(4.3, 32, 35, 30);  // the same on both platforms
  water->force->setCutoffDistance(0.6);
  water->system.addForce(water->force);
  return water;
}

}  // namespace OpenMMDCH
