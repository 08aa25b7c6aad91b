// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_BORN_KERNEL_H_
#define OPENMM_DCH_BORN_KERNEL_H_

#include <memory>
#include <openmm/Kernel.h>
#include <openmm/KernelFactory.h>
#include <openmm/OpenMMException.h>
#include <openmm/kernels.h>
#include <string>
#include <utility>

#include "BornForms.h"
#include "BornSum.h"
#include "internal/DropInRegistry.h"

namespace OpenMMDCH {

inline std::string nameOf(const OpenMM::GBSAOBCForce&) { return "GBSAOBCForce"; }
inline std::string nameOf(const OpenMM::CustomGBForce&) { return "CustomGBForce"; }

/// OpenMM's GBSAOBCForce or CustomGBForce by the sum that a platform has of ours, or by OpenMM's own kernel
/// where that does not cover the force.
/// @tparam Base  OpenMM's kernel for the Force
template <class Base, class Force>
class BornKernel : public Base {
 public:
  /// @param ofOpenMM  makes OpenMM's own kernels; it and the context outlive this
  BornKernel(const std::string& kernelName, const OpenMM::Platform& onPlatform,
             OpenMM::ContextImpl& ofContext, std::unique_ptr<BornSum> ofPlatform,
             const OpenMM::KernelFactory& ofOpenMM)
      : Base(kernelName, onPlatform),
        context(ofContext),
        nativeFactory(ofOpenMM),
        sum(std::move(ofPlatform)) {}
  ~BornKernel() override {
    if (owner) DropInRegistry::get().forget(context.getOwner(), *owner);
  }

  void initialize(const OpenMM::System& system, const Force& force) override {
    BornModel model;
    const std::string reason = readModel(force, model);
    if (reason.empty()) {
      sum->take(model);
    } else {
      sum.reset();
      native = OpenMM::Kernel(nativeFactory.createKernelImpl(this->getName(), this->getPlatform(), context));
      native.getAs<Base>().initialize(system, force);
      DropInRegistry::get().sayOnce(nameOf(force), reason);
    }
    owner = &force;
    DropInRegistry::get().remember(context.getOwner(), force,
                                   {0, force.getName(), sum ? "DCH" : "OpenMM", "", reason});
  }
  double execute(OpenMM::ContextImpl& ofContext, bool includeForces, bool includeEnergy) override {
    if (!sum) return native.getAs<Base>().execute(ofContext, includeForces, includeEnergy);
    return sum->add(ofContext, includeEnergy);
  }
  void copyParametersToContext(OpenMM::ContextImpl& ofContext, const Force& force) override {
    if (!sum) return native.getAs<Base>().copyParametersToContext(ofContext, force);
    BornModel model = sum->taken();
    if (static_cast<std::size_t>(force.getNumParticles()) != model.particles.size())
      throw OpenMM::OpenMMException("updateParametersInContext: The number of particles has changed");
    readChanges(force, model);
    if (const std::string fault = faultOf(model); !fault.empty())
      throw OpenMM::OpenMMException("openmm_dch: " + fault);
    sum->take(model);
  }

 private:
  OpenMM::ContextImpl& context;
  const OpenMM::KernelFactory& nativeFactory;
  const Force* owner = nullptr;
  std::unique_ptr<BornSum> sum;  ///< null if OpenMM's kernel computes the force
  OpenMM::Kernel native;
};

using GBSAOBCKernel = BornKernel<OpenMM::CalcGBSAOBCForceKernel, OpenMM::GBSAOBCForce>;
using CustomGBKernel = BornKernel<OpenMM::CalcCustomGBForceKernel, OpenMM::CustomGBForce>;

/// What a platform's factory gives for a force of implicit solvent: the drop-in, or OpenMM's own kernel while
/// that is not enabled.
template <class KernelOfOurs>
OpenMM::KernelImpl* makeBornKernel(const std::string& name, const OpenMM::Platform& platform,
                                   OpenMM::ContextImpl& context, std::unique_ptr<BornSum> ofPlatform,
                                   const OpenMM::KernelFactory& native) {
  DropInRegistry& registry = DropInRegistry::get();
  if (registry.isEnabled()) return new KernelOfOurs(name, platform, context, std::move(ofPlatform), native);
  registry.countNative();
  return native.createKernelImpl(name, platform, context);
}

}  // namespace OpenMMDCH

#endif
