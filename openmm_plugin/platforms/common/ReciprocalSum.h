// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_RECIPROCAL_SUM_H_
#define OPENMM_DCH_RECIPROCAL_SUM_H_

#include <openmm/NonbondedForce.h>
#include <openmm/System.h>
#include <openmm/internal/ContextImpl.h>
#include <string>
#include <vector>

#include <dch/forces/ewald_mesh.hpp>

#include "internal/DCHParameterSet.h"

namespace OpenMMDCH {

/// Whether a version of OpenMM, "8.1.2" for example, takes a net charge away by an even background: 8.3 and
/// later ones.
bool countsBackground(const std::string& version);
/// What such a background adds to the energy of a net charge in a lattice sum [kJ/mol].
double energyOfBackground(double charge, double splitting, double volume);

/// The part of a lattice sum in reciprocal space, on a platform on the processor.
class ReciprocalSum {
 public:
  /// @param ofWhat  charges, or coefficients of dispersion
  explicit ReciprocalSum(dch::LatticeSum ofWhat) : what(ofWhat) {}
  virtual ~ReciprocalSum() = default;

  virtual void initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force) = 0;
  double splitting() const { return alpha; }  ///< [1/nm]
  /// Three numbers, or null for a sum without a grid.
  virtual const int* gridSize() const { return nullptr; }
  /// Adds forces to those of the Context [kJ/mol/nm] and returns the energy [kJ/mol], that of each particle
  /// with itself taken away, and that of a background where OpenMM counts it.
  double add(OpenMM::ContextImpl& context, const std::vector<DCHParameterSet::Particle>& particles);
  /// Adds forces likewise.
  /// @param charges  or coefficients of dispersion
  /// @return the energy, that of each charge with itself included
  virtual double addWithThemselves(OpenMM::ContextImpl& context, const std::vector<double>& charges) = 0;
  /// As NonbondedStatus has it.
  virtual std::string computedBy() const = 0;

 protected:
  bool isOfDispersion() const { return what == dch::LatticeSum::dispersion; }

  dch::LatticeSum what;
  double alpha = 0;

 private:
  std::vector<double> chargesNow;
};

}  // namespace OpenMMDCH

#endif
