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
#include "ContextThreads.h"
#include "CpuBornSum.h"
#include "CpuMeshSum.h"
#include "CpuNonbondedSum.h"
#include "DCHNonbondedKernel.h"
#include "DoubleMeshSum.h"
#include "DropInKernel.h"
#include "EwaldSum.h"
#include "NecklaceContactKernel.h"
#include "ReciprocalKernel.h"
#include "internal/DropInRegistry.h"

namespace {

bool isDouble() { return OpenMMDCH::DropInRegistry::get().isDouble(); }

std::unique_ptr<OpenMMDCH::MeshSum> meshFor(dch::LatticeSum what, bool isOurs, OpenMM::ThreadPool& threads) {
  if (!isOurs || isDouble()) return std::make_unique<OpenMMDCH::DoubleMeshSum>(what);
  return std::make_unique<OpenMMDCH::CpuMeshSum>(what, threads);
}

class CpuDCHKernelFactory : public OpenMM::KernelFactory {
 public:
  OpenMM::KernelImpl* createKernelImpl(std::string name, const OpenMM::Platform& platform,
                                       OpenMM::ContextImpl& context) const override {
    OpenMM::ThreadPool& threads = OpenMM::CpuPlatform::getPlatformData(context).threads;
    if (name == OpenMMDCH::CalcDCHNonbondedForceKernel::Name())
      return new OpenMMDCH::DCHNonbondedKernel(
          name, platform, std::make_unique<OpenMMDCH::CpuNonbondedSum>(threads, isDouble()));
    if (name == OpenMM::CalcNonbondedForceKernel::Name())
      return OpenMMDCH::makeNonbondedKernel(name, platform, context, sumsFor(threads), native);
    if (name == OpenMM::CalcGBSAOBCForceKernel::Name())
      return OpenMMDCH::makeBornKernel<OpenMMDCH::GBSAOBCKernel>(name, platform, context, bornSumFor(threads),
                                                                 native);
    if (name == OpenMM::CalcCustomGBForceKernel::Name())
      return OpenMMDCH::makeBornKernel<OpenMMDCH::CustomGBKernel>(name, platform, context,
                                                                  bornSumFor(threads), native);
    if (name == OpenMMDCH::CalcNecklaceContactForceKernel::Name())
      return new OpenMMDCH::NecklaceContactKernel(name, platform, OpenMMDCH::threadsBeside(threads));
    throw OpenMM::OpenMMException("OpenMMDCH has no kernel named " + name);
  }

 private:
  static OpenMMDCH::SumsOfPlatform sumsFor(OpenMM::ThreadPool& threads) {
    OpenMMDCH::SumsOfPlatform sums;
    sums.pairs = std::make_unique<OpenMMDCH::CpuNonbondedSum>(threads, isDouble());
    sums.waves = std::make_unique<OpenMMDCH::EwaldSum>(OpenMMDCH::threadsBeside(threads));
    sums.mesh = meshFor(dch::LatticeSum::coulomb, true, threads);
    sums.dispersionMesh = meshFor(dch::LatticeSum::dispersion, true, threads);
    return sums;
  }
  static std::unique_ptr<OpenMMDCH::BornSum> bornSumFor(OpenMM::ThreadPool& threads) {
    if (isDouble()) return std::make_unique<OpenMMDCH::BornSum>();
    return std::make_unique<OpenMMDCH::CpuBornSum>(threads);
  }

  OpenMM::CpuKernelFactory native;
};

/// For OpenMM's own NonbondedForce. Without ours being asked for OpenMM's function computes what that force
/// would have computed with it.
class CpuReciprocalKernelFactory : public OpenMM::KernelFactory {
 public:
  OpenMM::KernelImpl* createKernelImpl(std::string name, const OpenMM::Platform& platform,
                                       OpenMM::ContextImpl& context) const override {
    using OpenMM::CalcDispersionPmeReciprocalForceKernel;
    using OpenMM::CalcPmeReciprocalForceKernel;
    if (name == CalcPmeReciprocalForceKernel::Name())
      return new OpenMMDCH::ReciprocalKernel<CalcPmeReciprocalForceKernel>(
          name, platform, context, meshFor(dch::LatticeSum::coulomb, context));
    using OfDispersion =
        OpenMMDCH::ReciprocalKernel<CalcDispersionPmeReciprocalForceKernel, CalcPmeReciprocalForceKernel>;
    CalcDispersionPmeReciprocalForceKernel* const kernel =
        new OfDispersion(name, platform, context, meshFor(dch::LatticeSum::dispersion, context));
    return kernel;
  }

 private:
  static std::unique_ptr<OpenMMDCH::MeshSum> meshFor(dch::LatticeSum what, OpenMM::ContextImpl& context) {
    const bool isOurs = OpenMMDCH::DropInRegistry::get().isReciprocalEnabled();
    return ::meshFor(what, isOurs, OpenMM::CpuPlatform::getPlatformData(context).threads);
  }
};

void registerReciprocal() {
  OpenMM::Platform& platform = OpenMM::Platform::getPlatformByName("CPU");
  auto* const factory = new CpuReciprocalKernelFactory();
  platform.registerKernelFactory(OpenMM::CalcPmeReciprocalForceKernel::Name(), factory);
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks): a Platform deletes its factories
  platform.registerKernelFactory(OpenMM::CalcDispersionPmeReciprocalForceKernel::Name(), factory);
}

}  // namespace

extern "C" OPENMM_EXPORT void registerPlatforms() {}

extern "C" OPENMM_EXPORT void registerKernelFactories() {
  for (int k = 0; k < OpenMM::Platform::getNumPlatforms(); ++k) {
    OpenMM::Platform& platform = OpenMM::Platform::getPlatform(k);
    if (platform.getName() != "CPU") continue;
    auto* const factory = new CpuDCHKernelFactory();
    for (const std::string& name :
         {OpenMMDCH::CalcDCHNonbondedForceKernel::Name(), OpenMMDCH::CalcNecklaceContactForceKernel::Name(),
          OpenMM::CalcNonbondedForceKernel::Name(), OpenMM::CalcGBSAOBCForceKernel::Name(),
          OpenMM::CalcCustomGBForceKernel::Name()})
      platform.registerKernelFactory(name, factory);
    // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks): a Platform deletes its factories
    OpenMMDCH::DropInRegistry::get().addPlatform(platform.getName());
    OpenMMDCH::DropInRegistry::get().setReciprocal(registerReciprocal);
    if (OpenMMDCH::DropInRegistry::get().isEnabled()) OpenMMDCH::DropInRegistry::get().registerReciprocal();
  }
}
