// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NECKLACE_CONTACT_FORCE_PROXY_H_
#define OPENMM_DCH_NECKLACE_CONTACT_FORCE_PROXY_H_

#include <openmm/serialization/SerializationProxy.h>

namespace OpenMMDCH {

/// A NecklaceContactForce as XML.
class NecklaceContactForceProxy : public OpenMM::SerializationProxy {
 public:
  NecklaceContactForceProxy() : SerializationProxy("NecklaceContactForce") {}
  void serialize(const void* object, OpenMM::SerializationNode& node) const override;
  void* deserialize(const OpenMM::SerializationNode& node) const override;
};

}  // namespace OpenMMDCH

#endif
