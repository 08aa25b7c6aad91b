// SPDX-License-Identifier: MIT
#include "ReciprocalSum.h"

#include <cmath>
#include <cstdlib>
#include <openmm/Platform.h>

#include "HostState.h"
#include "PairPotential.h"

namespace OpenMMDCH {

bool countsBackground(const std::string& version) {
  const std::size_t dot = version.find('.');
  const int major = std::atoi(version.c_str());
  const int minor = dot == std::string::npos ? 0 : std::atoi(version.c_str() + dot + 1);
  return major > 8 || (major == 8 && minor >= 3);
}

double energyOfBackground(double charge, double splitting, double volume) {
  const double pi = std::acos(-1.0);
  return -PairPotential::coulombConstant() * pi * charge * charge / (2 * volume * splitting * splitting);
}

double ReciprocalSum::add(OpenMM::ContextImpl& context,
                          const std::vector<DCHParameterSet::Particle>& particles) {
  chargesNow.clear();
  double squares = 0, total = 0;
  for (const DCHParameterSet::Particle& p : particles) {
    const double charge = isOfDispersion() ? PairPotential::dispersionOf(p) : p.charge;
    chargesNow.push_back(charge);
    squares += charge * charge;
    total += charge;
  }
  if (squares == 0) return 0;
  const double ofThemselves =
      isOfDispersion() ? -std::pow(alpha, 6) / 12 * squares
                       : PairPotential::coulombConstant() * alpha / std::sqrt(std::acos(-1.0)) * squares;
  const double energy = addWithThemselves(context, chargesNow) - ofThemselves;
  static const bool isCounted = countsBackground(OpenMM::Platform::getOpenMMVersion());
  if (isOfDispersion() || !isCounted) return energy;
  return energy + energyOfBackground(total, alpha, boxOf(boxVectorsOf(context)).volume());
}

}  // namespace OpenMMDCH
