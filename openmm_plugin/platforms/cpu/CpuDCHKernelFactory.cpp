// SPDX-License-Identifier: MIT
//
// The plugin of the CPU platform.
#include <CpuKernelFactory.h>
#include <CpuPlatform.h>
#include <memory>
#include <openmm/KernelFactory.h>
#include <openmm/OpenMMException.h>
#include <openmm/Platform.h>
#include <openmm/PluginInitializer.h>
#include <openmm/kernels.h>

#include "BornKernel.h"
#include "CpuBornSum.h"
#include "CpuNonbondedSum.h"
#include "CpuReciprocalSum.h"
#include "DCHNonbondedKernel.h"
#include "DropInKernel.h"
#include "NecklaceContactKernel.h"
#include "PoolExecutor.h"
#include "internal/DropInRegistry.h"

namespace {

class CpuDCHKernelFactory : public OpenMM::KernelFactory {
 public:
  OpenMM::KernelImpl* createKernelImpl(std::string name, const OpenMM::Platform& platform,
                                       OpenMM::ContextImpl& context) const override {
    OpenMM::ThreadPool& threads = OpenMM::CpuPlatform::getPlatformData(context).threads;
    if (name == OpenMMDCH::CalcDCHNonbondedForceKernel::Name())
      return new OpenMMDCH::DCHNonbondedKernel(name, platform,
                                               std::make_unique<OpenMMDCH::CpuNonbondedSum>(threads));
    if (name == OpenMM::CalcNonbondedForceKernel::Name())
      return OpenMMDCH::makeNonbondedKernel(name, platform, context,
                                            {std::make_unique<OpenMMDCH::CpuNonbondedSum>(threads),
                                             std::make_unique<OpenMMDCH::CpuReciprocalSum>(threads)},
                                            native);
    if (name == OpenMM::CalcGBSAOBCForceKernel::Name())
      return OpenMMDCH::makeBornKernel<OpenMMDCH::GBSAOBCKernel>(
          name, platform, context, std::make_unique<OpenMMDCH::CpuBornSum>(threads), native);
    if (name == OpenMM::CalcCustomGBForceKernel::Name())
      return OpenMMDCH::makeBornKernel<OpenMMDCH::CustomGBKernel>(
          name, platform, context, std::make_unique<OpenMMDCH::CpuBornSum>(threads), native);
    if (name == OpenMMDCH::CalcNecklaceContactForceKernel::Name())
      return new OpenMMDCH::NecklaceContactKernel(name, platform,
                                                  std::make_unique<OpenMMDCH::PoolExecutor>(threads));
    throw OpenMM::OpenMMException("OpenMMDCH has no kernel named " + name);
  }

 private:
  OpenMM::CpuKernelFactory native;
};

}  // namespace

extern "C" OPENMM_EXPORT void registerPlatforms() {}

extern "C" OPENMM_EXPORT void registerKernelFactories() {
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks): a Platform deletes its factories
  for (int k = 0; k < OpenMM::Platform::getNumPlatforms(); ++k) {
    OpenMM::Platform& platform = OpenMM::Platform::getPlatform(k);
    if (platform.getName() != "CPU") continue;
    auto* const factory = new CpuDCHKernelFactory();
    for (const std::string& name :
         {OpenMMDCH::CalcDCHNonbondedForceKernel::Name(), OpenMMDCH::CalcNecklaceContactForceKernel::Name(),
          OpenMM::CalcNonbondedForceKernel::Name(), OpenMM::CalcGBSAOBCForceKernel::Name(),
          OpenMM::CalcCustomGBForceKernel::Name()})
      platform.registerKernelFactory(name, factory);
    OpenMMDCH::DropInRegistry::get().addPlatform(platform.getName());
  }
}
