// SPDX-License-Identifier: MIT
#include "ContactPotential.h"

#include <cmath>

namespace OpenMMDCH {
namespace {

constexpr double kPi = 3.14159265358979323846;

PairTerms wca(double strength, double r2, double touch) {
  const double q2 = touch * touch / r2, q6 = q2 * q2 * q2;
  return {strength * (q6 - 1) * (q6 - 1), 12 * strength * q6 * (q6 - 1) / r2};
}

PairTerms harmonic(double strength, double r2, double touch) {
  const double r = std::sqrt(r2), overlap = touch - r;
  return {0.5 * strength * overlap * overlap, r > 0 ? strength * overlap / r : 0};
}

PairTerms softCosine(double strength, double r2, double touch) {
  const double r = std::sqrt(r2), phase = kPi * r / touch;
  return {strength * (1 + std::cos(phase)), r > 0 ? strength * kPi / touch * std::sin(phase) / r : 0};
}

}  // namespace

PairTerms ContactPotential::ofBeads(double r2, double touch) const {
  if (r2 >= touch * touch || strength == 0) return {};
  switch (function) {
    case NecklaceContactForce::WCA:
      return wca(strength, r2, touch);
    case NecklaceContactForce::Harmonic:
      return harmonic(strength, r2, touch);
    case NecklaceContactForce::SoftCosine:
      return softCosine(strength, r2, touch);
  }
  return {};
}

}  // namespace OpenMMDCH
