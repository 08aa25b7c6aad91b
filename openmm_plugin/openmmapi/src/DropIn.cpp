// SPDX-License-Identifier: MIT
#include "DropIn.h"

#include <openmm/CustomGBForce.h>
#include <openmm/GBSAOBCForce.h>
#include <openmm/NonbondedForce.h>
#include <openmm/OpenMMException.h>
#include <openmm/Platform.h>
#include <openmm/System.h>

#include "DCHNonbondedForce.h"
#include "internal/DropInRegistry.h"

namespace OpenMMDCH {
namespace {

bool hasPlatformOfOpenMM(const std::string& name) {
  for (int k = 0; k < OpenMM::Platform::getNumPlatforms(); ++k)
    if (OpenMM::Platform::getPlatform(k).getName() == name) return true;
  return false;
}

bool isImplicitSolvent(const OpenMM::Force& force) {
  return dynamic_cast<const OpenMM::GBSAOBCForce*>(&force) ||
         dynamic_cast<const OpenMM::CustomGBForce*>(&force);
}

/// Of a force for which no kernel of ours was asked.
std::string reasonWithoutKernel(const std::string& platform) {
  if (!DropInRegistry::get().hasPlatform(platform))
    return "there are no kernels of openmm_dch for the platform " + platform;
  return "the drop-in was not enabled when the Context was made";
}

void requirePlatforms() {
  DropInRegistry& registry = DropInRegistry::get();
  for (const std::string name : {"Reference", "CPU"})
    if (hasPlatformOfOpenMM(name) && !registry.hasPlatform(name))
      throw OpenMM::OpenMMException(
          "openmm_dch: the platform " + name +
          " has no kernels of openmm_dch; load OpenMM's own plugins first, then those "
          "of openmm_dch");
  if (!hasPlatformOfOpenMM("CPU"))
    throw OpenMM::OpenMMException(
        "openmm_dch: OpenMM has no platform CPU here; see whether the environment variable OPENMM_PLUGIN_DIR "
        "names a folder without OpenMM's own plugins");
}

bool isOnMesh(const OpenMM::NonbondedForce& force) {
  const auto method = force.getNonbondedMethod();
  return method == OpenMM::NonbondedForce::PME || method == OpenMM::NonbondedForce::LJPME;
}

}  // namespace

void enableDropIn(DropInPrecision precision) {
  requirePlatforms();
  DropInRegistry& registry = DropInRegistry::get();
  registry.setDouble(precision == DropInPrecision::Double);
  registry.setEnabled(true);
  registry.registerReciprocal();
}

bool enableReciprocal() {
  requirePlatforms();
  if (!DropInRegistry::get().registerReciprocal()) return false;
  DropInRegistry::get().setReciprocalEnabled(true);
  return true;
}

void disableDropIn() {
  DropInRegistry::get().setDouble(false);
  DropInRegistry::get().setEnabled(false);
  DropInRegistry::get().setReciprocalEnabled(false);
}

bool isDropInEnabled() { return DropInRegistry::get().isEnabled(); }

int countOfForcesBeforeDropIn() { return DropInRegistry::get().nativeCount(); }

std::vector<NonbondedStatus> nonbondedStatus(const OpenMM::Context& context) {
  std::vector<NonbondedStatus> all;
  const OpenMM::System& system = context.getSystem();
  for (int k = 0; k < system.getNumForces(); ++k) {
    const OpenMM::Force& force = system.getForce(k);
    NonbondedStatus status{k, force.getName(), "DCH", "", ""};
    const auto* const own = dynamic_cast<const OpenMM::NonbondedForce*>(&force);
    if (own || isImplicitSolvent(force)) {
      if (!DropInRegistry::get().find(context, force, status)) {
        const bool hasLatticeSum = own && own->getNonbondedMethod() > OpenMM::NonbondedForce::CutoffPeriodic;
        status.direct = "OpenMM";
        status.reciprocal = hasLatticeSum ? "OpenMM" : "";
        status.reason = reasonWithoutKernel(context.getPlatform().getName());
      }
    } else if (!dynamic_cast<const DCHNonbondedForce*>(&force)) {
      continue;
    }
    if (own && isOnMesh(*own) && status.reciprocal == "OpenMM" && DropInRegistry::get().hasMesh(context))
      status.reciprocal = "DCH";
    status.force = k;
    all.push_back(status);
  }
  return all;
}

}  // namespace OpenMMDCH
