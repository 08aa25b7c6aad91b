// SPDX-License-Identifier: MIT
#include "PairPotential.h"

#include <cmath>
#include <openmm/reference/SimTKOpenMMRealType.h>

namespace OpenMMDCH {
namespace {

PairTerms lennardJones(double sigma, double epsilon, double r2) {
  if (epsilon == 0) return {};
  const double s2 = sigma * sigma / r2, s6 = s2 * s2 * s2;
  return {4 * epsilon * (s6 * s6 - s6), 24 * epsilon * (2 * s6 * s6 - s6) / r2};
}

/// Of two particles that count 1 for dispersion, with a splitting of 1 and y = r^2: (1 - e^-y (1 + y + y^2 /
/// 2)) / y^3, and 6 (1 - e^-y (1 + y + y^2 / 2 + y^3 / 6)) / y^4; where y is small, by what the brackets
/// leave of e^y.
PairTerms farDispersion(double y) {
  const double gauss = std::exp(-y);
  double rest = 0;
  if (y > 3) {
    rest = (1 - gauss * (1 + y * (1 + y / 2 * (1 + y / 3)))) / (y * y * y * y);
  } else {
    double term = gauss / 24;
    for (int k = 5; k < 36; ++k) {
      rest += term;
      term *= y / k;
    }
  }
  return {gauss / 6 + y * rest, 6 * rest};
}

}  // namespace

PairPotential::PairPotential(const OpenMM::NonbondedForce& force, const Splittings& splittings)
    : alpha(splittings) {
  if (force.getNonbondedMethod() == OpenMM::NonbondedForce::NoCutoff) return;
  cutoff = force.getCutoffDistance();
  switched = force.getUseSwitchingFunction();
  switchFrom = force.getSwitchingDistance();
  if (splitting() > 0) return;
  const double dielectric = force.getReactionFieldDielectric();
  krf = std::pow(cutoff, -3) * (dielectric - 1) / (2 * dielectric + 1);
  crf = 1 / cutoff * 3 * dielectric / (2 * dielectric + 1);
}

double PairPotential::coulombConstant() { return ONE_4PI_EPS0; }

double PairPotential::dispersionOf(const DCHParameterSet::Particle& particle) {
  return 2 * particle.sigma * particle.sigma * particle.sigma * std::sqrt(particle.epsilon);
}

PairTerms PairPotential::ofParticles(const DCHParameterSet::Particle& a, const DCHParameterSet::Particle& b,
                                     double r2) const {
  if (cutoff > 0 && r2 >= cutoff * cutoff) return {};
  const double sigma = 0.5 * (a.sigma + b.sigma), epsilon = std::sqrt(a.epsilon * b.epsilon);
  PairTerms terms = lennardJones(sigma, epsilon, r2);
  if (hasDispersionSum()) {
    const double product = dispersionOf(a) * dispersionOf(b), cutoff2 = cutoff * cutoff;
    terms = terms - dispersionInReciprocalSpace(product, r2);
    terms.energy +=
        dispersionInReciprocalSpace(product, cutoff2).energy - lennardJones(sigma, epsilon, cutoff2).energy;
  }
  const double r = std::sqrt(r2);
  if (switched && r > switchFrom) {
    const double t = (r - switchFrom) / (cutoff - switchFrom);
    const double value = 1 + t * t * t * (-10 + t * (15 - t * 6));
    const double slope = t * t * (-30 + t * (60 - t * 30)) / (cutoff - switchFrom);
    terms.forceOverR = value * terms.forceOverR - slope * terms.energy / r;
    terms.energy *= value;
  }
  if (const double charges = coulombConstant() * a.charge * b.charge; charges != 0) {
    const double near = std::erfc(splitting() * r) / r;
    terms.energy += charges * (near + krf * r2 - crf);
    terms.forceOverR += charges * ((near + gaussian(r2)) / r2 - 2 * krf);
  }
  return terms;
}

/// 2 splitting / sqrt(pi) e^-(splitting r)^2
double PairPotential::gaussian(double r2) const {
  return 2 * splitting() / std::sqrt(PI_M) * std::exp(-splitting() * splitting() * r2);
}

bool PairPotential::isInReciprocalSpace(const DCHParameterSet::Particle& a,
                                        const DCHParameterSet::Particle& b) const {
  return (splitting() > 0 && a.charge * b.charge != 0) || (hasDispersionSum() && a.epsilon * b.epsilon != 0);
}

PairTerms PairPotential::inReciprocalSpace(const DCHParameterSet::Particle& a,
                                           const DCHParameterSet::Particle& b, double r2) const {
  PairTerms terms;
  if (a.charge * b.charge != 0) terms = chargesInReciprocalSpace(a.charge * b.charge, r2);
  if (!hasDispersionSum()) return terms;
  const PairTerms dispersion = dispersionInReciprocalSpace(dispersionOf(a) * dispersionOf(b), r2);
  return {terms.energy + dispersion.energy, terms.forceOverR + dispersion.forceOverR};
}

PairTerms PairPotential::dispersionInReciprocalSpace(double product, double r2) const {
  const double alpha2 = alpha.dispersion * alpha.dispersion, scale = -product * alpha2 * alpha2 * alpha2;
  const PairTerms far = farDispersion(alpha2 * r2);
  return {scale * far.energy, scale * alpha2 * far.forceOverR};
}

PairTerms PairPotential::chargesInReciprocalSpace(double chargeProd, double r2) const {
  const double charges = coulombConstant() * chargeProd, r = std::sqrt(r2);
  // Where particles coincide there is an energy, and no force.
  if (r2 == 0) return {charges * gaussian(0), 0};
  const double far = std::erf(splitting() * r) / r;
  return {charges * far, charges * (far - gaussian(r2)) / r2};
}

PairTerms PairPotential::ofException(const DCHParameterSet::Exception& exception, double r2) {
  PairTerms terms = lennardJones(exception.sigma, exception.epsilon, r2);
  if (exception.chargeProd != 0) {
    const double bare = coulombConstant() * exception.chargeProd / std::sqrt(r2);
    terms.energy += bare;
    terms.forceOverR += bare / r2;
  }
  return terms;
}

}  // namespace OpenMMDCH
