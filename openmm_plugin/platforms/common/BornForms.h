// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_BORN_FORMS_H_
#define OPENMM_DCH_BORN_FORMS_H_

#include <openmm/CustomGBForce.h>
#include <openmm/GBSAOBCForce.h>
#include <string>

#include "BornModel.h"

namespace OpenMMDCH {

/// The model of a force. Returns "", or why OpenMM has to compute it.
std::string readModel(const OpenMM::GBSAOBCForce& force, BornModel& model);
/// The same of the forms that openmm.app writes as a CustomGBForce (GBSAHCTForce, GBSAOBC1Force,
/// GBSAOBC2Force, GBSAGBnForce, GBSAGBn2Force), recognised by their expressions letter by letter.
std::string readModel(const OpenMM::CustomGBForce& force, BornModel& model);

/// Parameters of particles, into a model that has been read from the same force before.
void readParticles(const OpenMM::GBSAOBCForce& force, BornModel& model);
void readParticles(const OpenMM::CustomGBForce& force, BornModel& model);

}  // namespace OpenMMDCH

#endif
