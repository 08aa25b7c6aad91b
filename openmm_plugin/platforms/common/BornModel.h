// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_BORN_MODEL_H_
#define OPENMM_DCH_BORN_MODEL_H_

#include <string>
#include <vector>

#include <dch/forces/generalized_born.hpp>

namespace OpenMMDCH {

/// A generalized Born model as GBSAOBCForce computes it, and as openmm.app writes it as a CustomGBForce; see
/// dch/forces/generalized_born.hpp for integrals and energies of pairs. With I the integral of a particle, a
/// its radius less the offset and psi = I a, its Born radius is
///     B = 1 / (1/a - tanh(alpha psi - beta psi^2 + gamma psi^3) / radius)   or, with hct, B = 1 / (1/a - I).
struct BornModel {
  struct Particle {
    double charge = 0;        ///< [e]
    double offsetRadius = 0;  ///< a [nm]
    double scaledRadius = 0;  ///< [nm]
    double radius = 0;        ///< [nm]
    double alpha = 0, beta = 0, gamma = 0;
    int kind = 0;  ///< of necks
  };

  int form = 0;       ///< of those that openmm.app writes
  double cutoff = 0;  ///< 0 without one [nm]
  bool isPeriodic = false;
  bool hct = false;
  bool countsInside = false;  ///< as in GBSAOBCForce, not in the forms of openmm.app
  dch::BornEnergy energy;
  double surface = 0;    ///< times (radius + 0.14 nm)^2 (radius/B)^6 is an energy [kJ/mol/nm^2]
  dch::BornNecks necks;  ///< kinds is 0 without them; kinds of particles stand with those
  std::vector<Particle> particles;
};

/// "" if all is as it has to be for a Born radius to have a value, else what is not.
std::string faultOf(const BornModel& model);

/// A number that depends on one other, and its derivative.
struct ValueAndSlope {
  double value = 0, slope = 0;
};

/// The Born radius, by the integral.
ValueAndSlope bornRadius(const BornModel& model, const BornModel::Particle& particle, double integral);
/// The energy of a particle by itself, by its Born radius: in its own field, and of its surface.
ValueAndSlope energyOfParticle(const BornModel& model, const BornModel::Particle& particle,
                               double bornRadius);
/// What a particle's integral gets from another one, by the distance. Particles at the same place count as
/// at their limit.
ValueAndSlope integralOfPair(const BornModel& model, const BornModel::Particle& particle,
                             const BornModel::Particle& other, double distance);

/// The energy of a pair, its force over its distance, and dE/dB times B, the same for both particles.
struct BornPairTerms {
  double energy = 0, forceOverR = 0, slope = 0;
};
BornPairTerms energyOfPair(const dch::BornEnergy& energy, double charges, double bornRadii, double r2);

}  // namespace OpenMMDCH

#endif
