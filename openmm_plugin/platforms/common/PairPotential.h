// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_PAIR_POTENTIAL_H_
#define OPENMM_DCH_PAIR_POTENTIAL_H_

#include <openmm/NonbondedForce.h>

#include "internal/DCHParameterSet.h"

namespace OpenMMDCH {

/// Energy of a pair, and its force over its distance: the force on the second particle is forceOverR times
/// the displacement from the first to it.
struct PairTerms {
  double energy = 0, forceOverR = 0;
};
inline PairTerms operator-(const PairTerms& a, const PairTerms& b) {
  return {a.energy - b.energy, a.forceOverR - b.forceOverR};
}

/// The potential of a nonbonded force in plain double: of pairs of particles, and of exceptions.
class PairPotential {
 public:
  /// @param splitting  of a lattice sum, of which this is the part in direct space; 0 without one [1/nm]
  PairPotential(const OpenMM::NonbondedForce& force, double splitting);

  bool hasCutoff() const { return cutoff > 0; }
  /// 0 without one [nm].
  double cutoffDistance() const { return cutoff; }
  bool isSwitched() const { return switched; }
  double switchingDistance() const { return switchFrom; }
  bool hasLatticeSum() const { return alpha > 0; }
  double splitting() const { return alpha; }
  /// The energy of two charges is constant q q (1/r + krf r^2 - crf), or constant q q erfc(splitting r) / r
  /// in a lattice sum; both are 0 there and without a cutoff.
  double reactionFieldK() const { return krf; }
  double reactionFieldC() const { return crf; }
  static double coulombConstant();  ///< [kJ nm/mol/e^2]

  /// @param r2  squared distance [nm^2]; nothing acts at the cutoff and beyond
  PairTerms ofParticles(const DCHParameterSet::Particle& a, const DCHParameterSet::Particle& b,
                        double r2) const;
  static PairTerms ofException(const DCHParameterSet::Exception& exception, double r2);
  /// What the sum in reciprocal space holds of a pair, constant q q erf(splitting r) / r.
  PairTerms inReciprocalSpace(double chargeProd, double r2) const;

 private:
  double gaussian(double r2) const;

  double cutoff = 0, switchFrom = 0, krf = 0, crf = 0, alpha = 0;
  bool switched = false;
};

}  // namespace OpenMMDCH

#endif
