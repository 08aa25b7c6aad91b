// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NONBONDED_FORCE_PROXY_H_
#define OPENMM_DCH_NONBONDED_FORCE_PROXY_H_

#include <openmm/serialization/SerializationProxy.h>

namespace OpenMMDCH {

/// A DCHNonbondedForce as XML.
class DCHNonbondedForceProxy : public OpenMM::SerializationProxy {
 public:
  DCHNonbondedForceProxy() : SerializationProxy("DCHNonbondedForce") {}
  void serialize(const void* object, OpenMM::SerializationNode& node) const override;
  void* deserialize(const OpenMM::SerializationNode& node) const override;
};

}  // namespace OpenMMDCH

#endif
