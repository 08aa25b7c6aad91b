// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_DROP_IN_REGISTRY_H_
#define OPENMM_DCH_DROP_IN_REGISTRY_H_

#include <map>
#include <mutex>
#include <openmm/Context.h>
#include <openmm/Force.h>
#include <set>
#include <string>
#include <utility>

#include "DropIn.h"

namespace OpenMMDCH {

/// What the plugins of all platforms and the callers of the drop-in share, as OpenMM's list of platforms is
/// shared.
class DropInRegistry {
 public:
  static DropInRegistry& get();

  void setEnabled(bool value);
  bool isEnabled();
  /// Of kernels of ours that are made from now on, on platforms that have a choice.
  void setDouble(bool value);
  bool isDouble();
  /// A platform now has the kernels.
  void addPlatform(const std::string& name);
  bool hasPlatform(const std::string& name);
  /// A force was given to OpenMM's kernel because the drop-in is not enabled.
  void countNative();
  /// How often that happened before it was first enabled; 0 from then on.
  int nativeCount();

  /// What has OpenMM's own kernels on the platform CPU find ours for reciprocal space.
  void setReciprocal(void (*registration)());
  /// Calls it, the first time. There has to be one.
  /// @return false if the platform has such kernels of others
  bool registerReciprocal();
  /// Of kernels for reciprocal space that are made from now on; those of the drop-in, while it is enabled,
  /// too.
  void setReciprocalEnabled(bool value);
  bool isReciprocalEnabled();
  /// A mesh of ours is made for OpenMM's kernel in a Context, and is destroyed.
  void addMesh(const OpenMM::Context& context);
  void removeMesh(const OpenMM::Context& context);
  bool hasMesh(const OpenMM::Context& context);

  /// Remembers who computes a force of a Context, until it is forgotten.
  void remember(const OpenMM::Context& context, const OpenMM::Force& force, const NonbondedStatus& status);
  void forget(const OpenMM::Context& context, const OpenMM::Force& force);
  /// False if nobody said so.
  bool find(const OpenMM::Context& context, const OpenMM::Force& force, NonbondedStatus& status);
  /// Writes why a kind of force keeps OpenMM's kernel to standard error, unless that was done before.
  void sayOnce(const std::string& force, const std::string& reason);

 private:
  DropInRegistry();

  std::mutex mutex;
  bool enabled, wasEnabled, isAllDouble = false;
  int natives = 0;
  void (*reciprocal)() = nullptr;
  bool isReciprocalRegistered = false, isReciprocalWanted = false;
  std::set<std::string> platforms, said;
  std::multiset<const OpenMM::Context*> contextsWithMesh;
  std::map<std::pair<const OpenMM::Context*, const OpenMM::Force*>, NonbondedStatus> statusOf;
};

}  // namespace OpenMMDCH

#endif
