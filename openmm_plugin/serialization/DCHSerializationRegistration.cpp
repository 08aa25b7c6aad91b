// SPDX-License-Identifier: MIT
#include "DCHNonbondedForce.h"
#include "DCHNonbondedForceProxy.h"
#include "NecklaceContactForce.h"
#include "NecklaceContactForceProxy.h"

namespace {

// When the library is loaded, so that files with these forces can be read from then on.
[[gnu::constructor]] void registerSerializationProxies() {
  OpenMM::SerializationProxy::registerProxy(typeid(OpenMMDCH::DCHNonbondedForce),
                                            new OpenMMDCH::DCHNonbondedForceProxy());
  OpenMM::SerializationProxy::registerProxy(typeid(OpenMMDCH::NecklaceContactForce),
                                            new OpenMMDCH::NecklaceContactForceProxy());
}

}  // namespace
