// SPDX-License-Identifier: MIT
#include "internal/DropInRegistry.h"

#include <cstdlib>
#include <iostream>
#include <openmm/Platform.h>

namespace OpenMMDCH {
namespace {

using Lock = std::lock_guard<std::mutex>;

bool isAskedForByEnvironment() {
  const char* const value = std::getenv("OPENMM_DCH");
  return value && std::string(value) == "1";
}

}  // namespace

DropInRegistry::DropInRegistry() : enabled(isAskedForByEnvironment()), wasEnabled(enabled) {}

DropInRegistry& DropInRegistry::get() {
  // Never destroyed: Contexts may outlive all that is static.
  static DropInRegistry& registry = *new DropInRegistry();
  return registry;
}

void DropInRegistry::setEnabled(bool value) {
  const Lock lock(mutex);
  enabled = value;
  wasEnabled = wasEnabled || value;
  if (value) natives = 0;
}

bool DropInRegistry::isEnabled() {
  const Lock lock(mutex);
  return enabled;
}

void DropInRegistry::setDouble(bool value) {
  const Lock lock(mutex);
  isAllDouble = value;
}

bool DropInRegistry::isDouble() {
  const Lock lock(mutex);
  return isAllDouble;
}

void DropInRegistry::addPlatform(const std::string& name) {
  const Lock lock(mutex);
  platforms.insert(name);
}

bool DropInRegistry::hasPlatform(const std::string& name) {
  const Lock lock(mutex);
  return platforms.count(name) > 0;
}

void DropInRegistry::countNative() {
  const Lock lock(mutex);
  if (!wasEnabled) ++natives;
}

int DropInRegistry::nativeCount() {
  const Lock lock(mutex);
  return natives;
}

void DropInRegistry::setReciprocal(void (*registration)()) {
  const Lock lock(mutex);
  reciprocal = registration;
}

bool DropInRegistry::registerReciprocal() {
  const Lock lock(mutex);
  if (isReciprocalRegistered) return true;
  OpenMM::Platform& platform = OpenMM::Platform::getPlatformByName("CPU");
  for (const std::string name : {"CalcPmeReciprocalForce", "CalcDispersionPmeReciprocalForce"})
    if (platform.supportsKernels({name})) return false;
  reciprocal();
  isReciprocalRegistered = true;
  return true;
}

void DropInRegistry::setReciprocalEnabled(bool value) {
  const Lock lock(mutex);
  isReciprocalWanted = value;
}

bool DropInRegistry::isReciprocalEnabled() {
  const Lock lock(mutex);
  return enabled || isReciprocalWanted;
}

void DropInRegistry::addMesh(const OpenMM::Context& context) {
  const Lock lock(mutex);
  contextsWithMesh.insert(&context);
}

void DropInRegistry::removeMesh(const OpenMM::Context& context) {
  const Lock lock(mutex);
  contextsWithMesh.erase(contextsWithMesh.find(&context));
}

bool DropInRegistry::hasMesh(const OpenMM::Context& context) {
  const Lock lock(mutex);
  return contextsWithMesh.count(&context) > 0;
}

void DropInRegistry::remember(const OpenMM::Context& context, const OpenMM::Force& force,
                              const NonbondedStatus& status) {
  const Lock lock(mutex);
  statusOf[{&context, &force}] = status;
}

void DropInRegistry::forget(const OpenMM::Context& context, const OpenMM::Force& force) {
  const Lock lock(mutex);
  statusOf.erase({&context, &force});
}

bool DropInRegistry::find(const OpenMM::Context& context, const OpenMM::Force& force,
                          NonbondedStatus& status) {
  const Lock lock(mutex);
  const auto found = statusOf.find({&context, &force});
  if (found != statusOf.end()) status = found->second;
  return found != statusOf.end();
}

void DropInRegistry::sayOnce(const std::string& force, const std::string& reason) {
  const Lock lock(mutex);
  if (said.insert(force + ": " + reason).second)
    std::cerr << "openmm_dch: a " << force << " keeps OpenMM's own kernel: " << reason << std::endl;
}

}  // namespace OpenMMDCH
