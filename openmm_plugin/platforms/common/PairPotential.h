// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_PAIR_POTENTIAL_H_
#define OPENMM_DCH_PAIR_POTENTIAL_H_

#include "DCHNonbondedForce.h"
#include "internal/DCHParameterSet.h"

namespace OpenMMDCH {

/// Energy of a pair, and its force over its distance: the force on the second particle is forceOverR times
/// the displacement from the first to it.
struct PairTerms {
  double energy = 0, forceOverR = 0;
};

/// The potential of a DCHNonbondedForce in plain double: of pairs of particles, and of exceptions.
class PairPotential {
 public:
  explicit PairPotential(const DCHNonbondedForce& force);

  bool hasCutoff() const { return cutoff > 0; }
  /// 0 without one [nm].
  double cutoffDistance() const { return cutoff; }
  bool isSwitched() const { return switched; }
  double switchingDistance() const { return switchFrom; }
  /// With a cutoff the energy of two charges is constant q q (1/r + krf r^2 - crf), else the first term only.
  double reactionFieldK() const { return krf; }
  double reactionFieldC() const { return crf; }
  static double coulombConstant();  ///< [kJ nm/mol/e^2]

  /// @param r2  squared distance [nm^2]; nothing acts at the cutoff and beyond
  PairTerms ofParticles(const DCHParameterSet::Particle& a, const DCHParameterSet::Particle& b,
                        double r2) const;
  static PairTerms ofException(const DCHParameterSet::Exception& exception, double r2);

 private:
  double cutoff = 0, switchFrom = 0, krf = 0, crf = 0;
  bool switched = false;
};

}  // namespace OpenMMDCH

#endif
