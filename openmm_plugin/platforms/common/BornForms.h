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

/// What an update may have changed, parameters of particles and tables, into a model that has been read from
/// the same force before.
/// @throws OpenMM::OpenMMException for a table of another shape, or a wrong number of parameters
void readChanges(const OpenMM::GBSAOBCForce& force, BornModel& model);
void readChanges(const OpenMM::CustomGBForce& force, BornModel& model);

}  // namespace OpenMMDCH

#endif
