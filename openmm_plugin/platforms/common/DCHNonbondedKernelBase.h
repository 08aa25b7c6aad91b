// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NONBONDED_KERNEL_BASE_H_
#define OPENMM_DCH_NONBONDED_KERNEL_BASE_H_

#include <optional>

#include <dch/base/span.hpp>
#include <dch/lists/exclusions.hpp>

#include "DCHKernels.h"
#include "HostState.h"
#include "PairPotential.h"
#include "internal/DCHParameterSet.h"

namespace OpenMMDCH {

/// What platforms on the processor share: all of a DCHNonbondedForce but the sum over pairs of particles.
class DCHNonbondedKernelBase : public CalcDCHNonbondedForceKernel {
 public:
  using CalcDCHNonbondedForceKernel::CalcDCHNonbondedForceKernel;

  void initialize(const OpenMM::System& system, const DCHNonbondedForce& force) override;
  double execute(OpenMM::ContextImpl& context, bool includeForces, bool includeEnergy) override;
  void copyParametersToContext(OpenMM::ContextImpl& context, const DCHNonbondedForce& force) override;

 protected:
  /// Adds the forces of all pairs that are not excluded and, if that is asked for, returns their energy.
  virtual double addPairs(OpenMM::ContextImpl& context, const HostState& state, bool includeEnergy) = 0;
  /// The parameters are not those of the last time (or it is the first).
  virtual void parametersChanged() {}

  const DCHParameterSet& parameters() const { return *parameterSet; }
  const PairPotential& potential() const { return *pairPotential; }
  const dch::Exclusions& exclusions() const { return excludedPairs; }

  /// Adds the forces of particles i and j and returns their energy.
  double addPair(const HostState& state, std::size_t i, std::size_t j, dch::Span<dch::Vec3> forces) const;
  /// The same for all pairs of particles with the smaller index first, first + stride, ...
  double addRows(const HostState& state, std::size_t first, std::size_t stride,
                 dch::Span<dch::Vec3> forces) const;

 private:
  HostState stateOf(OpenMM::ContextImpl& context) const;
  double addExceptions(const HostState& state) const;

  bool isPeriodic = false, exceptionsArePeriodic = false;
  std::optional<DCHParameterSet> parameterSet;
  std::optional<PairPotential> pairPotential;
  dch::Exclusions excludedPairs;
  double dispersionCoefficient = 0;  ///< energy times volume [kJ/mol nm^3]
};

}  // namespace OpenMMDCH

#endif
