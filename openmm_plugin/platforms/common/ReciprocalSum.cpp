// SPDX-License-Identifier: MIT
#include "ReciprocalSum.h"

#include <cmath>

#include "PairPotential.h"

namespace OpenMMDCH {

double ReciprocalSum::add(OpenMM::ContextImpl& context,
                          const std::vector<DCHParameterSet::Particle>& particles) {
  chargesNow.clear();
  double squares = 0;
  for (const DCHParameterSet::Particle& p : particles) {
    chargesNow.push_back(p.charge);
    squares += p.charge * p.charge;
  }
  const double ofThemselves = PairPotential::coulombConstant() * alpha / std::sqrt(std::acos(-1.0)) * squares;
  return addWithThemselves(context, chargesNow) - ofThemselves;
}

}  // namespace OpenMMDCH
