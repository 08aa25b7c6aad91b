// SPDX-License-Identifier: MIT
#include "internal/DCHNonbondedChecks.h"

#include <algorithm>
#include <cmath>
#include <openmm/OpenMMException.h>
#include <set>
#include <sstream>
#include <utility>

using OpenMM::OpenMMException;

namespace OpenMMDCH {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw OpenMMException("DCHNonbondedForce: " + what); }

/// Of a number that may be OpenMM's own force's.
[[noreturn]] void refuseNumber(const std::string& what) { throw OpenMMException("openmm_dch: " + what); }

void checkCutoff(const DCHNonbondedForce& force, const OpenMM::System& system) {
  const double cutoff = force.getCutoffDistance();
  if (!(std::isfinite(cutoff) && cutoff > 0))
    refuse("the cutoff distance is " + textOf(cutoff) + " nm; it must be finite and positive");
  const double from = force.getSwitchingDistance();
  if (force.getUseSwitchingFunction() && !(from >= 0 && from < cutoff))
    refuse("the switching distance is " + textOf(from) +
           " nm; it must be at least 0 and less than the cutoff, " + textOf(cutoff) + " nm");
  if (force.getUseSwitchingFunction() && from == 0 && force.getUseDispersionCorrection() &&
      force.usesPeriodicBoundaryConditions())
    refuse(
        "the switching distance is 0, for which the dispersion correction has no value; choose a larger one, "
        "or setUseDispersionCorrection(false)");
  const double dielectric = force.getReactionFieldDielectric();
  if (!(std::isfinite(dielectric) && dielectric >= 0))
    refuse("the reaction field dielectric is " + textOf(dielectric) + "; it must be finite and not negative");
  if (force.getNonbondedMethod() != DCHNonbondedForce::CutoffPeriodic) return;
  OpenMM::Vec3 box[3];
  system.getDefaultPeriodicBoxVectors(box[0], box[1], box[2]);
  checkBox(box, cutoff, "DCHNonbondedForce");
}

void checkParticles(const DCHNonbondedForce& force) {
  for (int i = 0; i < force.getNumParticles(); ++i) {
    double charge, sigma, epsilon;
    force.getParticleParameters(i, charge, sigma, epsilon);
    const std::string of = "particle " + std::to_string(i);
    checkFinite("charge", charge, of);
    checkNotNegative("sigma", sigma, of);
    checkNotNegative("epsilon", epsilon, of);
  }
}

void checkExceptions(const DCHNonbondedForce& force) {
  std::set<std::pair<int, int> > seen;
  for (int k = 0; k < force.getNumExceptions(); ++k) {
    int i, j;
    double chargeProd, sigma, epsilon;
    force.getExceptionParameters(k, i, j, chargeProd, sigma, epsilon);
    const std::string of = "exception " + std::to_string(k);
    for (int particle : {i, j})
      if (particle < 0 || particle >= force.getNumParticles())
        refuse(of + " names particle " + std::to_string(particle) + "; there are " +
               std::to_string(force.getNumParticles()));
    if (i == j) refuse(of + " names particle " + std::to_string(i) + " twice");
    if (!seen.insert(std::minmax(i, j)).second)
      refuse(of + " is a second one for particles " + std::to_string(i) + " and " + std::to_string(j));
    checkFinite("charge product", chargeProd, of);
    checkNotNegative("sigma", sigma, of);
    checkNotNegative("epsilon", epsilon, of);
  }
}

void checkOffsets(const DCHNonbondedForce& force) {
  const auto check = [](const std::string& kind, int offset, int index, int count) {
    if (index < 0 || index >= count)
      refuse(kind + " parameter offset " + std::to_string(offset) + " names " + kind + " " +
             std::to_string(index) + "; there are " + std::to_string(count));
  };
  std::string parameter;
  int index;
  double first, second, third;
  for (int k = 0; k < force.getNumParticleParameterOffsets(); ++k) {
    force.getParticleParameterOffset(k, parameter, index, first, second, third);
    check("particle", k, index, force.getNumParticles());
  }
  for (int k = 0; k < force.getNumExceptionParameterOffsets(); ++k) {
    force.getExceptionParameterOffset(k, parameter, index, first, second, third);
    check("exception", k, index, force.getNumExceptions());
  }
}

}  // namespace

std::string textOf(double value) {
  std::ostringstream text;
  text.precision(10);
  text << value;
  return text.str();
}

void checkNotNegative(const std::string& name, double value, const std::string& of) {
  if (!(std::isfinite(value) && value >= 0))
    refuseNumber(name + " of " + of + " is " + textOf(value) + "; it must be finite and not negative");
}

void checkFinite(const std::string& name, double value, const std::string& of) {
  if (!std::isfinite(value))
    refuseNumber(name + " of " + of + " is " + textOf(value) + "; it must be finite");
}

void checkBox(const OpenMM::Vec3* boxVectors, double cutoff, const std::string& complaint) {
  for (int axis = 0; axis < 3; ++axis) {
    const double width = boxVectors[axis][axis];
    if (!(cutoff <= 0.5 * width))
      throw OpenMMException(complaint + ": the cutoff distance " + textOf(cutoff) +
                            " nm exceeds half of the periodic box, which is " + textOf(width) +
                            " nm wide along " + "xyz"[axis] + "; choose a smaller cutoff or a larger box");
  }
}

void checkBoxOfNow(const OpenMM::Vec3* boxVectors, double cutoff) {
  checkBox(boxVectors, cutoff,
           "The periodic box size has decreased to less than twice the nonbonded cutoff");  // as OpenMM says
}

void checkForce(const DCHNonbondedForce& force, const OpenMM::System& system) {
  if (force.getNumParticles() != system.getNumParticles())
    refuse("it has parameters for " + std::to_string(force.getNumParticles()) +
           " particles, but the System has " + std::to_string(system.getNumParticles()) +
           "; add one set for each");
  if (force.getNonbondedMethod() != DCHNonbondedForce::NoCutoff) checkCutoff(force, system);
  checkParticles(force);
  checkExceptions(force);
  checkOffsets(force);
}

}  // namespace OpenMMDCH
