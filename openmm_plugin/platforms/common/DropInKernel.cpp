// SPDX-License-Identifier: MIT
#include "DropInKernel.h"

#include <openmm/OpenMMException.h>
#include <set>
#include <utility>

#include "internal/DropInRegistry.h"

namespace OpenMMDCH {
namespace {

using OpenMM::NonbondedForce;

/// Why OpenMM's own kernel computes a force, "" if ours does.
std::string reasonForNative(const NonbondedForce& force) {
  if (force.getNonbondedMethod() == NonbondedForce::LJPME && force.getUseSwitchingFunction())
    return "a switching function with the method LJPME is not covered";
  if (force.getUseSwitchingFunction() && force.getSwitchingDistance() <= 0 &&
      force.getUseDispersionCorrection() && force.usesPeriodicBoundaryConditions())
    return "the dispersion correction has no value for a switching distance of 0";
  return "";
}

void readGrid(const ReciprocalSum* sum, const std::string& methods, double& alpha, int& nx, int& ny,
              int& nz) {
  if (!sum || !sum->gridSize())
    throw OpenMM::OpenMMException("getPMEParametersInContext: This Context is not using " + methods);
  alpha = sum->splitting();
  nx = sum->gridSize()[0];
  ny = sum->gridSize()[1];
  nz = sum->gridSize()[2];
}

/// The same for what the splitting parameter of a lattice sum times the cutoff is.
std::string reasonForNative(double splittingTimesCutoff) {
  constexpr double kMax = 6;  // of the series of dch::CoulombTerm and dch::DispersionTerm
  return splittingTimesCutoff <= kMax ? "" : "the splitting parameter times the cutoff is over 6";
}

/// How many exceptions act, or may by an offset: OpenMM has this number stay.
int countOfActingExceptions(const NonbondedForce& force) {
  std::string parameter;
  int k, i, j;
  double first, second, third;
  std::set<int> offset;
  for (int n = 0; n < force.getNumExceptionParameterOffsets(); ++n) {
    force.getExceptionParameterOffset(n, parameter, k, first, second, third);
    offset.insert(k);
  }
  int count = 0;
  for (k = 0; k < force.getNumExceptions(); ++k) {
    double chargeProd, sigma, epsilon;
    force.getExceptionParameters(k, i, j, chargeProd, sigma, epsilon);
    count += chargeProd != 0 || epsilon != 0 || offset.count(k) > 0;
  }
  return count;
}

OpenMM::CalcNonbondedForceKernel& kernelIn(OpenMM::Kernel& kernel) {
  return kernel.getAs<OpenMM::CalcNonbondedForceKernel>();
}

// Before OpenMM 8.2 a kernel takes all parameters anew, from then on a range of them.
template <class Kernel>
auto copyParameters(Kernel& kernel, OpenMM::ContextImpl& context, const NonbondedForce& force,
                    const int* /*range*/, int /*preferred*/)
    -> decltype(kernel.copyParametersToContext(context, force)) {
  kernel.copyParametersToContext(context, force);
}
template <class Kernel>
auto copyParameters(Kernel& kernel, OpenMM::ContextImpl& context, const NonbondedForce& force,
                    const int* range, long /*otherwise*/)
    -> decltype(kernel.copyParametersToContext(context, force, 0, 0, 0, 0)) {
  kernel.copyParametersToContext(context, force, range[0], range[1], range[2], range[3]);
}

}  // namespace

DropInKernel::DropInKernel(const std::string& kernelName, const OpenMM::Platform& onPlatform,
                           OpenMM::ContextImpl& ofContext, SumsOfPlatform ofPlatform,
                           const OpenMM::KernelFactory& ofOpenMM)
    : CalcNonbondedForceKernel(kernelName, onPlatform),
      context(ofContext),
      nativeFactory(ofOpenMM),
      sums(std::move(ofPlatform)) {}

DropInKernel::~DropInKernel() {
  if (owner) DropInRegistry::get().forget(context.getOwner(), *owner);
}

void DropInKernel::initialize(const OpenMM::System& system, const NonbondedForce& force) {
  std::string reason = reasonForNative(force);
  chooseReciprocal(force);
  for (ReciprocalSum* const sum : {reciprocal, dispersion}) {
    if (!reason.empty() || !sum) continue;
    sum->initialize(system, force);
    reason = reasonForNative(sum->splitting() * force.getCutoffDistance());
  }
  if (reason.empty()) {
    const auto splittingOf = [](const ReciprocalSum* sum) { return sum ? sum->splitting() : 0; };
    sums.pairs->initialize(system, force, {splittingOf(reciprocal), splittingOf(dispersion)});
  } else {
    giveToNative(system, force);
    DropInRegistry::get().sayOnce("NonbondedForce", reason);
  }
  owner = &force;
  actingExceptions = countOfActingExceptions(force);
  rememberStatus(reason);
}

void DropInKernel::chooseReciprocal(const NonbondedForce& force) {
  const auto method = force.getNonbondedMethod();
  if (method == NonbondedForce::Ewald) reciprocal = sums.waves.get();
  if (method == NonbondedForce::PME || method == NonbondedForce::LJPME) reciprocal = sums.mesh.get();
  if (method == NonbondedForce::LJPME) dispersion = sums.dispersionMesh.get();
}

void DropInKernel::giveToNative(const OpenMM::System& system, const NonbondedForce& force) {
  sums = {};
  reciprocal = dispersion = nullptr;
  native = OpenMM::Kernel(nativeFactory.createKernelImpl(getName(), getPlatform(), context));
  kernelIn(native).initialize(system, force);
}

void DropInKernel::rememberStatus(const std::string& reason) {
  const bool hasLatticeSum = owner->getNonbondedMethod() > NonbondedForce::CutoffPeriodic;
  const std::string ofOpenMM = hasLatticeSum ? "OpenMM" : "";
  DropInRegistry::get().remember(context.getOwner(), *owner,
                                 {0, owner->getName(), sums.pairs ? "DCH" : "OpenMM",
                                  reciprocal ? reciprocal->computedBy() : ofOpenMM, reason});
}

double DropInKernel::execute(OpenMM::ContextImpl& ofContext, bool includeForces, bool includeEnergy,
                             bool includeDirect, bool includeReciprocal) {
  if (!sums.pairs)
    return kernelIn(native).execute(ofContext, includeForces, includeEnergy, includeDirect,
                                    includeReciprocal);
  sums.pairs->follow(ofContext);
  double energy = 0;
  if (includeDirect) energy += sums.pairs->add(ofContext, includeEnergy);
  for (ReciprocalSum* const sum : {reciprocal, dispersion})
    if (includeReciprocal && sum) energy += sum->add(ofContext, sums.pairs->parameters().particles());
  return energy;
}

void DropInKernel::copyParametersToContext(OpenMM::ContextImpl& ofContext, const NonbondedForce& force) {
  copyParametersToContext(ofContext, force, 0, force.getNumParticles() - 1, 0, force.getNumExceptions() - 1);
}

void DropInKernel::copyParametersToContext(OpenMM::ContextImpl& ofContext, const NonbondedForce& force,
                                           int firstParticle, int lastParticle, int firstException,
                                           int lastException) {
  const int range[] = {firstParticle, lastParticle, firstException, lastException};
  if (!sums.pairs) return copyParameters(kernelIn(native), ofContext, force, range, 0);
  const int actingNow = countOfActingExceptions(force);
  if (actingNow != actingExceptions)
    throw OpenMM::OpenMMException(
        "updateParametersInContext: The number of non-excluded exceptions has changed from " +
        std::to_string(actingExceptions) + " to " + std::to_string(actingNow) + "; reinitialize the Context");
  sums.pairs->copyParameters(ofContext.getSystem(), force);
}

void DropInKernel::getPMEParameters(double& alpha, int& nx, int& ny, int& nz) const {
  if (!sums.pairs)
    return native.getAs<OpenMM::CalcNonbondedForceKernel>().getPMEParameters(alpha, nx, ny, nz);
  readGrid(reciprocal, "PME or LJPME", alpha, nx, ny, nz);
}

void DropInKernel::getLJPMEParameters(double& alpha, int& nx, int& ny, int& nz) const {
  if (sums.pairs) return readGrid(dispersion, "LJPME", alpha, nx, ny, nz);
  native.getAs<OpenMM::CalcNonbondedForceKernel>().getLJPMEParameters(alpha, nx, ny, nz);
}

OpenMM::KernelImpl* makeNonbondedKernel(const std::string& name, const OpenMM::Platform& platform,
                                        OpenMM::ContextImpl& context, SumsOfPlatform ofPlatform,
                                        const OpenMM::KernelFactory& native) {
  DropInRegistry& registry = DropInRegistry::get();
  if (registry.isEnabled()) return new DropInKernel(name, platform, context, std::move(ofPlatform), native);
  registry.countNative();
  return native.createKernelImpl(name, platform, context);
}

}  // namespace OpenMMDCH
