// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "NecklaceContactForce.h"
#include "all_pairs_oracle.hpp"

namespace OpenMMDCH {

inline constexpr NecklaceContactForce::EnergyFunction kEnergyFunctions[] = {
    NecklaceContactForce::WCA, NecklaceContactForce::Harmonic, NecklaceContactForce::SoftCosine};

/// Both platforms compute in double.
inline constexpr double kContactTolerance = 1e-10;

/// A System of chains and particles beside them.
struct ContactCase {
  OpenMM::System system;
  std::vector<Vec3> positions;
  NecklaceContactForce* force = new NecklaceContactForce();  // owned by the System

  ContactCase() { system.addForce(force); }
  int add_particle(Vec3 at) {
    positions.push_back(at);
    return system.addParticle(50);
  }
  void add_chain(const std::vector<Vec3>& at, const std::vector<double>& radii, bool closed = false) {
    std::vector<int> particles;
    for (const Vec3& p : at) particles.push_back(add_particle(p));
    force->addChain(particles, radii, closed);
  }
  void add_chain(const std::vector<Vec3>& at, double radius, bool closed = false) {
    add_chain(at, std::vector<double>(at.size(), radius), closed);
  }
  void set_box(const Vec3* box) {
    system.setDefaultPeriodicBoxVectors(box[0], box[1], box[2]);
    force->setUsesPeriodicBoundaryConditions(true);
  }
};

inline Evaluation evaluate(const ContactCase& of, const std::string& platform) {
  return Host(of.system, platform).evaluate(of.positions);
}

/// Energy of two beads and -dE/dr by the formulas of the manual; touch is the sum of the radii.
inline RadialTerms bead_terms(const NecklaceContactForce& force, double r, double touch) {
  const double s = force.getStrength();
  if (r >= touch) return {};
  switch (force.getEnergyFunction()) {
    case NecklaceContactForce::WCA: {
      const RadialTerms terms = lennard_jones(touch / std::pow(2, 1.0 / 6), s, r);
      return {terms.energy + s, terms.force};
    }
    case NecklaceContactForce::Harmonic:
      return {s / 2 * std::pow(touch - r, 2), s * (touch - r)};
    case NecklaceContactForce::SoftCosine:
      return {s + s * std::cos(M_PI * r / touch), s * M_PI / touch * std::sin(M_PI * r / touch)};
  }
  return {};
}

/// Calls act(i, j, apart, touch) for all pairs of beads that may act on each other, i < j, and their images.
template <class F>
void for_each_pair(const NecklaceContactForce& force, const std::vector<Vec3>& positions, const Vec3* box,
                   const F& act) {
  struct Bead {
    int particle, chain, along;
    double radius;
  };
  std::vector<Bead> beads;
  std::vector<int> particles, ring;  // ring: beads of a closed chain, else 0
  std::vector<double> radii;
  for (int c = 0; c < force.getNumChains(); ++c) {
    bool closed;
    force.getChainParameters(c, particles, radii, closed);
    const int size = static_cast<int>(particles.size());
    for (int k = 0; k < size; ++k) {
      const auto bead = static_cast<std::size_t>(k);
      beads.push_back({particles[bead], c, k, radii[bead]});
    }
    ring.push_back(closed ? size : 0);
  }
  std::sort(beads.begin(), beads.end(), [](const Bead& a, const Bead& b) { return a.particle < b.particle; });
  for (std::size_t a = 0; a < beads.size(); ++a)
    for (std::size_t b = a + 1; b < beads.size(); ++b) {
      const Bead &p = beads[a], &q = beads[b];
      if (!(p.chain == q.chain ? force.getActsWithinChains() : force.getActsBetweenChains())) continue;
      if (p.chain == q.chain) {
        int bonds = std::abs(p.along - q.along);
        if (const int around = ring[static_cast<std::size_t>(p.chain)]; around > 0)
          bonds = std::min(bonds, around - bonds);
        if (bonds <= force.getExcludedBonds()) continue;
      }
      const auto i = static_cast<std::size_t>(p.particle), j = static_cast<std::size_t>(q.particle);
      for_each_image(positions[j] - positions[i], box,
                     [&](const Vec3& apart) { act(i, j, apart, p.radius + q.radius); });
    }
}

/// Energy and forces by all pairs of beads and all their images, in plain double. `box` may be null.
inline Evaluation all_contacts(const NecklaceContactForce& force, const std::vector<Vec3>& positions,
                               const Vec3* box) {
  Evaluation result{0, std::vector<Vec3>(positions.size())};
  for_each_pair(force, positions, box, [&](std::size_t i, std::size_t j, const Vec3& apart, double touch) {
    const double r = std::sqrt(apart.dot(apart));
    const RadialTerms terms = bead_terms(force, r, touch);
    if (terms.force == 0) return;
    const Vec3 f = apart * (terms.force / r);
    result.forces[j] += f;
    result.forces[i] -= f;
    result.energy += terms.energy;
  });
  return result;
}

/// The contacts by all pairs, in order.
inline std::vector<NecklaceContact> contact_oracle(const NecklaceContactForce& force,
                                                   const std::vector<Vec3>& positions, const Vec3* box,
                                                   double max_gap) {
  std::vector<NecklaceContact> result;
  for_each_pair(force, positions, box, [&](std::size_t i, std::size_t j, const Vec3& apart, double touch) {
    const double gap = std::sqrt(apart.dot(apart)) - touch;
    if (gap <= max_gap) result.push_back({static_cast<int>(i), static_cast<int>(j), gap});
  });
  return result;
}

/// A ring of beads `bond` apart on a circle around a center, in the plane of x and y.
inline std::vector<Vec3> circle(int beads, double bond, const Vec3& center) {
  const double radius = bond / (2 * std::sin(M_PI / beads));
  std::vector<Vec3> result;
  for (int k = 0; k < beads; ++k) {
    const double angle = 2 * M_PI * k / beads;
    result.push_back(center + Vec3(std::cos(angle), std::sin(angle), 0) * radius);
  }
  return result;
}

/// Three walks with bonds of 0.25, a ring, a single bead and solvent, in disorder: no two particles closer
/// than 0.15, so that no force dwarfs the others, and beads with radii of 0.1 to 0.2.
inline void make_tangle(ContactCase& tangle, const Vec3* box, std::uint64_t seed) {
  dch::scenes::Random random(seed);
  const auto is_free = [&](const Vec3& at, const std::vector<Vec3>& others) {
    return std::all_of(others.begin(), others.end(), [&](const Vec3& other) {
      bool apart = true;
      for_each_image(at - other, box, [&](const Vec3& d) { apart = apart && d.dot(d) > 0.15 * 0.15; });
      return apart;
    });
  };
  const auto some_radii = [&](std::size_t beads) {
    std::vector<double> radii(beads);
    for (double& radius : radii) radius = random.uniform(0.1, 0.2);
    return radii;
  };
  if (box) tangle.set_box(box);
  tangle.add_chain(circle(20, 0.25, Vec3(1, 1, 1)), some_radii(20), true);
  for (const std::size_t beads : {std::size_t{1}, std::size_t{17}, std::size_t{30}, std::size_t{42}}) {
    std::vector<Vec3> walk;
    for (int tries = 0; walk.size() < beads; ++tries) {
      if (tries % 200 == 199) walk.clear();
      const dch::Vec3 step = random.in_ball(1);
      const Vec3 ahead = Vec3(step.x, step.y, step.z) * (0.25 / std::sqrt(norm2(step)));
      const Vec3 at = walk.empty() ? random.vector<Vec3>(0, 2) : walk.back() + ahead;
      if (is_free(at, tangle.positions) && is_free(at, walk)) walk.push_back(at);
    }
    tangle.add_particle(Vec3(1, 1, 1) + Vec3(0.01, 0, 0) * static_cast<double>(beads));
    tangle.add_chain(walk, some_radii(beads));
  }
}

}  // namespace OpenMMDCH
