// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_DROP_IN_KERNEL_H_
#define OPENMM_DCH_DROP_IN_KERNEL_H_

#include <memory>
#include <openmm/Kernel.h>
#include <openmm/KernelFactory.h>
#include <openmm/kernels.h>
#include <string>

#include "DropIn.h"
#include "NonbondedSum.h"
#include "ReciprocalSum.h"

namespace OpenMMDCH {

struct SumsOfPlatform {
  std::unique_ptr<NonbondedSum> pairs;
  std::unique_ptr<ReciprocalSum> mesh;            ///< of charges, for PME and LJPME
  std::unique_ptr<ReciprocalSum> dispersionMesh;  ///< for LJPME
  std::unique_ptr<ReciprocalSum> waves;           ///< for Ewald
};

/// OpenMM's NonbondedForce by the sums that a platform has of ours, or by OpenMM's own kernel where
/// that does not cover the force.
class DropInKernel : public OpenMM::CalcNonbondedForceKernel {
 public:
  /// @param ofOpenMM  makes OpenMM's own kernels; it and the context outlive this
  DropInKernel(const std::string& kernelName, const OpenMM::Platform& onPlatform,
               OpenMM::ContextImpl& ofContext, SumsOfPlatform ofPlatform,
               const OpenMM::KernelFactory& ofOpenMM);
  ~DropInKernel() override;

  void initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force) override;
  double execute(OpenMM::ContextImpl& ofContext, bool includeForces, bool includeEnergy, bool includeDirect,
                 bool includeReciprocal) override;
  // Before OpenMM 8.2, and from then on. The one that the host has not overrides nothing.
  // NOLINTBEGIN(modernize-use-override)
  void copyParametersToContext(OpenMM::ContextImpl& ofContext, const OpenMM::NonbondedForce& force);
  void copyParametersToContext(OpenMM::ContextImpl& ofContext, const OpenMM::NonbondedForce& force,
                               int firstParticle, int lastParticle, int firstException, int lastException);
  // NOLINTEND(modernize-use-override)
  void getPMEParameters(double& alpha, int& nx, int& ny, int& nz) const override;
  void getLJPMEParameters(double& alpha, int& nx, int& ny, int& nz) const override;

 private:
  void chooseReciprocal(const OpenMM::NonbondedForce& force);
  void giveToNative(const OpenMM::System& system, const OpenMM::NonbondedForce& force);
  void rememberStatus(const std::string& reason);

  OpenMM::ContextImpl& context;
  const OpenMM::KernelFactory& nativeFactory;
  const OpenMM::NonbondedForce* owner = nullptr;
  int actingExceptions = 0;             ///< that act, or may by an offset
  SumsOfPlatform sums;                  ///< null if OpenMM's kernel computes the force
  ReciprocalSum* reciprocal = nullptr;  ///< one of them; null without a lattice sum too
  ReciprocalSum* dispersion = nullptr;  ///< the same, of dispersion
  OpenMM::Kernel native;
};

/// What a platform's factory gives for a NonbondedForce: the drop-in, or OpenMM's own kernel while that is
/// not enabled.
OpenMM::KernelImpl* makeNonbondedKernel(const std::string& name, const OpenMM::Platform& platform,
                                        OpenMM::ContextImpl& context, SumsOfPlatform ofPlatform,
                                        const OpenMM::KernelFactory& native);

}  // namespace OpenMMDCH

#endif
