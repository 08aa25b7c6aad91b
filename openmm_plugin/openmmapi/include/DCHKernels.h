// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_KERNELS_H_
#define OPENMM_DCH_KERNELS_H_

#include <openmm/KernelImpl.h>
#include <openmm/System.h>
#include <string>
#include <vector>

#include "DCHNonbondedForce.h"
#include "NecklaceContactForce.h"

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

/// What a platform has to offer for a NecklaceContactForce.
class CalcNecklaceContactForceKernel : public OpenMM::KernelImpl {
 public:
  static std::string Name() { return "CalcNecklaceContactForce"; }
  using KernelImpl::KernelImpl;

  /// @param force  has passed NecklaceContactForceImpl's checks
  virtual void initialize(const OpenMM::System& system, const NecklaceContactForce& force) = 0;
  /// Adds forces to those of the Context [kJ/mol/nm] and returns the energy [kJ/mol].
  virtual double execute(OpenMM::ContextImpl& context, bool includeForces, bool includeEnergy) = 0;
  virtual void copyParametersToContext(OpenMM::ContextImpl& context, const NecklaceContactForce& force) = 0;
  /// The pairs that act on each other with surfaces at most maxGap [nm] apart, in ascending order.
  virtual std::vector<NecklaceContact> contacts(OpenMM::ContextImpl& context, double maxGap) = 0;
  /// What the next search for contacts is made with, and why.
  virtual std::string search() const = 0;
};

}  // namespace OpenMMDCH

#endif
