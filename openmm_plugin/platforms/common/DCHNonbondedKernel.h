// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NONBONDED_KERNEL_H_
#define OPENMM_DCH_NONBONDED_KERNEL_H_

#include <memory>
#include <string>
#include <utility>

#include "DCHKernels.h"
#include "NonbondedSum.h"

namespace OpenMMDCH {

/// A DCHNonbondedForce by the sum over pairs that a platform has.
class DCHNonbondedKernel : public CalcDCHNonbondedForceKernel {
 public:
  DCHNonbondedKernel(const std::string& kernelName, const OpenMM::Platform& onPlatform,
                     std::unique_ptr<NonbondedSum> ofPlatform)
      : CalcDCHNonbondedForceKernel(kernelName, onPlatform), sum(std::move(ofPlatform)) {}

  void initialize(const OpenMM::System& system, const DCHNonbondedForce& force) override {
    sum->initialize(system, force.getParameters(), {});
  }
  double execute(OpenMM::ContextImpl& context, bool, bool includeEnergy) override {
    sum->follow(context);
    return sum->add(context, includeEnergy);
  }
  void copyParametersToContext(OpenMM::ContextImpl& context, const DCHNonbondedForce& force) override {
    sum->copyParameters(context.getSystem(), force.getParameters());
  }

 private:
  std::unique_ptr<NonbondedSum> sum;
};

}  // namespace OpenMMDCH

#endif
