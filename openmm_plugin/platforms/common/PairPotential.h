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

/// Of lattice sums, 0 without one [1/nm].
struct Splittings {
  double charges = 0, dispersion = 0;
};

/// The potential of a nonbonded force in plain double: of pairs of particles, and of exceptions.
class PairPotential {
 public:
  /// @param splittings  of lattice sums, of which this is the part in direct space
  PairPotential(const OpenMM::NonbondedForce& force, const Splittings& splittings);

  bool hasCutoff() const { return cutoff > 0; }
  /// 0 without one [nm].
  double cutoffDistance() const { return cutoff; }
  bool isSwitched() const { return switched; }
  double switchingDistance() const { return switchFrom; }
  double splitting() const { return alpha.charges; }
  bool hasDispersionSum() const { return alpha.dispersion > 0; }
  double dispersionSplitting() const { return alpha.dispersion; }
  /// The energy of two charges is constant q q (1/r + krf r^2 - crf), or constant q q erfc(splitting r) / r
  /// in a lattice sum; both are 0 there and without a cutoff.
  double reactionFieldK() const { return krf; }
  double reactionFieldC() const { return crf; }
  static double coulombConstant();  ///< [kJ nm/mol/e^2]
  /// What a particle counts for in a lattice sum of dispersion, whatever the mixing rules of pairs are.
  static double dispersionOf(const DCHParameterSet::Particle& particle);  ///< [kJ^1/2 nm^3/mol^1/2]

  /// With a lattice sum of dispersion energies but those of charges are lowered by what they are at the
  /// cutoff.
  /// @param r2  squared distance [nm^2]; nothing acts at the cutoff and beyond
  PairTerms ofParticles(const DCHParameterSet::Particle& a, const DCHParameterSet::Particle& b,
                        double r2) const;
  static PairTerms ofException(const DCHParameterSet::Exception& exception, double r2);
  /// What sums in reciprocal space hold of a pair: constant q q erf(splitting r) / r, and of dispersion
  /// -c c (1 - e^(-x^2) (1 + x^2 + x^4 / 2)) / r^6 with x = splitting r.
  PairTerms inReciprocalSpace(const DCHParameterSet::Particle& a, const DCHParameterSet::Particle& b,
                              double r2) const;
  /// Whether that is more than nothing.
  bool isInReciprocalSpace(const DCHParameterSet::Particle& a, const DCHParameterSet::Particle& b) const;

 private:
  double gaussian(double r2) const;
  PairTerms chargesInReciprocalSpace(double chargeProd, double r2) const;
  PairTerms dispersionInReciprocalSpace(double product, double r2) const;

  double cutoff = 0, switchFrom = 0, krf = 0, crf = 0;
  Splittings alpha;
  bool switched = false;
};

}  // namespace OpenMMDCH

#endif
