// SPDX-License-Identifier: MIT
//
// The plugin of the Reference platform.
#include <memory>
#include <openmm/KernelFactory.h>
#include <openmm/OpenMMException.h>
#include <openmm/Platform.h>
#include <openmm/PluginInitializer.h>
#include <openmm/kernels.h>
#include <openmm/reference/ReferenceKernelFactory.h>

#include "BornKernel.h"
#include "DCHNonbondedKernel.h"
#include "DoubleMeshSum.h"
#include "DropInKernel.h"
#include "EwaldSum.h"
#include "NecklaceContactKernel.h"
#include "ReferenceNonbondedSum.h"
#include "internal/DropInRegistry.h"

namespace {

class ReferenceDCHKernelFactory : public OpenMM::KernelFactory {
 public:
  OpenMM::KernelImpl* createKernelImpl(std::string name, const OpenMM::Platform& platform,
                                       OpenMM::ContextImpl& context) const override {
    if (name == OpenMMDCH::CalcDCHNonbondedForceKernel::Name())
      return new OpenMMDCH::DCHNonbondedKernel(name, platform,
                                               std::make_unique<OpenMMDCH::ReferenceNonbondedSum>());
    if (name == OpenMM::CalcNonbondedForceKernel::Name())
      return OpenMMDCH::makeNonbondedKernel(
          name, platform, context,
          {std::make_unique<OpenMMDCH::ReferenceNonbondedSum>(),
           std::make_unique<OpenMMDCH::DoubleMeshSum>(dch::LatticeSum::coulomb),
           std::make_unique<OpenMMDCH::DoubleMeshSum>(dch::LatticeSum::dispersion),
           std::make_unique<OpenMMDCH::EwaldSum>(nullptr)},
          native);
    if (name == OpenMM::CalcGBSAOBCForceKernel::Name())
      return OpenMMDCH::makeBornKernel<OpenMMDCH::GBSAOBCKernel>(
          name, platform, context, std::make_unique<OpenMMDCH::BornSum>(), native);
    if (name == OpenMM::CalcCustomGBForceKernel::Name())
      return OpenMMDCH::makeBornKernel<OpenMMDCH::CustomGBKernel>(
          name, platform, context, std::make_unique<OpenMMDCH::BornSum>(), native);
    if (name == OpenMMDCH::CalcNecklaceContactForceKernel::Name())
      return new OpenMMDCH::NecklaceContactKernel(name, platform);
    throw OpenMM::OpenMMException("OpenMMDCH has no kernel named " + name);
  }

 private:
  OpenMM::ReferenceKernelFactory native;
};

}  // namespace

extern "C" OPENMM_EXPORT void registerPlatforms() {}

extern "C" OPENMM_EXPORT void registerKernelFactories() {
  for (int k = 0; k < OpenMM::Platform::getNumPlatforms(); ++k) {
    OpenMM::Platform& platform = OpenMM::Platform::getPlatform(k);
    // By name: the CPU platform is a ReferencePlatform too.
    if (platform.getName() != "Reference") continue;
    auto* const factory = new ReferenceDCHKernelFactory();
    for (const std::string& name :
         {OpenMMDCH::CalcDCHNonbondedForceKernel::Name(), OpenMMDCH::CalcNecklaceContactForceKernel::Name(),
          OpenMM::CalcNonbondedForceKernel::Name(), OpenMM::CalcGBSAOBCForceKernel::Name(),
          OpenMM::CalcCustomGBForceKernel::Name()})
      platform.registerKernelFactory(name, factory);
    // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks): a Platform deletes its factories
    OpenMMDCH::DropInRegistry::get().addPlatform(platform.getName());
  }
}
