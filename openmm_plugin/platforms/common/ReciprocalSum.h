// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_RECIPROCAL_SUM_H_
#define OPENMM_DCH_RECIPROCAL_SUM_H_

#include <openmm/NonbondedForce.h>
#include <openmm/System.h>
#include <openmm/internal/ContextImpl.h>
#include <string>
#include <vector>

#include "internal/DCHParameterSet.h"

namespace OpenMMDCH {

/// The part of a particle mesh Ewald sum in reciprocal space, on a platform on the processor.
class ReciprocalSum {
 public:
  virtual ~ReciprocalSum() = default;

  /// Grid and splitting are those that OpenMM chooses; a platform may have a finer grid.
  void initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force);
  double splitting() const { return alpha; }
  const int* gridSize() const { return grid; }
  /// Adds forces to those of the Context [kJ/mol/nm] and returns the energy [kJ/mol], that of each particle
  /// with itself taken away.
  double add(OpenMM::ContextImpl& context, const std::vector<DCHParameterSet::Particle>& particles);
  /// As NonbondedStatus has it.
  virtual std::string computedBy() const = 0;

 protected:
  /// The grid is known.
  virtual void start(int particles) = 0;
  /// @return the energy, that of each charge with itself included
  virtual double addMesh(OpenMM::ContextImpl& context, const std::vector<double>& charges) = 0;

  double alpha = 0;
  int grid[3]{};

 private:
  std::vector<double> chargesNow;
};

}  // namespace OpenMMDCH

#endif
