// SPDX-License-Identifier: MIT
//
// The plugin of the Reference platform.
#include <openmm/KernelFactory.h>
#include <openmm/OpenMMException.h>
#include <openmm/Platform.h>
#include <openmm/PluginInitializer.h>

#include "NecklaceContactKernel.h"
#include "ReferenceDCHKernels.h"

namespace {

class ReferenceDCHKernelFactory : public OpenMM::KernelFactory {
 public:
  OpenMM::KernelImpl* createKernelImpl(std::string name, const OpenMM::Platform& platform,
                                       OpenMM::ContextImpl&) const override {
    if (name == OpenMMDCH::CalcDCHNonbondedForceKernel::Name())
      return new OpenMMDCH::ReferenceCalcDCHNonbondedForceKernel(name, platform);
    if (name == OpenMMDCH::CalcNecklaceContactForceKernel::Name())
      return new OpenMMDCH::NecklaceContactKernel(name, platform);
    throw OpenMM::OpenMMException("OpenMMDCH has no kernel named " + name);
  }
};

}  // namespace

extern "C" OPENMM_EXPORT void registerPlatforms() {}

extern "C" OPENMM_EXPORT void registerKernelFactories() {
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks): a Platform deletes its factories
  for (int k = 0; k < OpenMM::Platform::getNumPlatforms(); ++k) {
    OpenMM::Platform& platform = OpenMM::Platform::getPlatform(k);
    // By name: the CPU platform is a ReferencePlatform too.
    if (platform.getName() != "Reference") continue;
    auto* const factory = new ReferenceDCHKernelFactory();
    for (const std::string& name :
         {OpenMMDCH::CalcDCHNonbondedForceKernel::Name(), OpenMMDCH::CalcNecklaceContactForceKernel::Name()})
      platform.registerKernelFactory(name, factory);
  }
}
