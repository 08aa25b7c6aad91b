// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NONBONDED_CHECKS_H_
#define OPENMM_DCH_NONBONDED_CHECKS_H_

#include <openmm/System.h>
#include <string>

#include "DCHNonbondedForce.h"

namespace OpenMMDCH {

/// Everything that can be wrong with a force before positions are known.
/// @throws OpenMMException with the offending value.
void checkForce(const DCHNonbondedForce& force, const OpenMM::System& system);

/// A sigma or epsilon.
/// @param of  whose, "particle 3" for example
/// @throws OpenMMException if it is negative or not finite.
void checkNotNegative(const std::string& name, double value, const std::string& of);

/// A charge or product of charges.
/// @throws OpenMMException if it is not finite.
void checkFinite(const std::string& name, double value, const std::string& of);

/// @param complaint  what the message begins with
/// @throws OpenMMException if the cutoff is over half the width of the box along an axis.
void checkBox(const OpenMM::Vec3* boxVectors, double cutoff, const std::string& complaint);
/// The same of the box that a Context has by now.
void checkBoxOfNow(const OpenMM::Vec3* boxVectors, double cutoff);

/// A number as messages write it.
std::string textOf(double value);

}  // namespace OpenMMDCH

#endif
