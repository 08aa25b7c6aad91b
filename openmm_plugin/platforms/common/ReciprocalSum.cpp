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
    const double charge = isOfDispersion() ? PairPotential::dispersionOf(p) : p.charge;
    chargesNow.push_back(charge);
    squares += charge * charge;
  }
  if (squares == 0) return 0;
  const double ofThemselves =
      isOfDispersion() ? -std::pow(alpha, 6) / 12 * squares
                       : PairPotential::coulombConstant() * alpha / std::sqrt(std::acos(-1.0)) * squares;
  return addWithThemselves(context, chargesNow) - ofThemselves;
}

}  // namespace OpenMMDCH
