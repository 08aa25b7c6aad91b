// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_KERNELS_H_
#define OPENMM_DCH_KERNELS_H_

#include <openmm/KernelImpl.h>
#include <openmm/System.h>
#include <string>

#include "DCHNonbondedForce.h"

namespace OpenMMDCH {

/// What a platform has to offer for a DCHNonbondedForce.
class CalcDCHNonbondedForceKernel : public OpenMM::KernelImpl {
 public:
  static std::string Name() { return "CalcDCHNonbondedForce"; }
  using KernelImpl::KernelImpl;

  /// @param force  has passed DCHNonbondedForceImpl's checks
  virtual void initialize(const OpenMM::System& system, const DCHNonbondedForce& force) = 0;
  /// Adds forces to those of the Context [kJ/mol/nm] and returns the energy [kJ/mol].
  virtual double execute(OpenMM::ContextImpl& context, bool includeForces, bool includeEnergy) = 0;
  virtual void copyParametersToContext(OpenMM::ContextImpl& context, const DCHNonbondedForce& force) = 0;
};

}  // namespace OpenMMDCH

#endif
