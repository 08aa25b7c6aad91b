// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NECKLACE_CONTACT_CHECKS_H_
#define OPENMM_DCH_NECKLACE_CONTACT_CHECKS_H_

#include <openmm/System.h>

#include "NecklaceContactForce.h"

namespace OpenMMDCH {

/// Everything that can be wrong with a force before positions and the box are known.
/// @throws OpenMMException with the offending value.
void checkForce(const NecklaceContactForce& force, const OpenMM::System& system);

}  // namespace OpenMMDCH

#endif
