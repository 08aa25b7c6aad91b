// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_CONTACT_POTENTIAL_H_
#define OPENMM_DCH_CONTACT_POTENTIAL_H_

#include "NecklaceContactForce.h"
#include "PairPotential.h"

namespace OpenMMDCH {

/// The energy functions of a NecklaceContactForce.
class ContactPotential {
 public:
  explicit ContactPotential(const NecklaceContactForce& force)
      : function(force.getEnergyFunction()), strength(force.getStrength()) {}

  /// @param r2     squared distance [nm^2]
  /// @param touch  the sum of the radii, > 0 [nm]; nothing acts there and beyond
  /// @returns values that are not finite where WCA has none, at r2 near 0
  PairTerms ofBeads(double r2, double touch) const;

  void setStrength(double value) { strength = value; }

 private:
  NecklaceContactForce::EnergyFunction function;
  double strength;
};

}  // namespace OpenMMDCH

#endif
