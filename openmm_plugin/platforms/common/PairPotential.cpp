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

}  // namespace

PairPotential::PairPotential(const OpenMM::NonbondedForce& force, double splitting) : alpha(splitting) {
  if (force.getNonbondedMethod() == OpenMM::NonbondedForce::NoCutoff) return;
  cutoff = force.getCutoffDistance();
  switched = force.getUseSwitchingFunction();
  switchFrom = force.getSwitchingDistance();
  if (hasLatticeSum()) return;
  const double dielectric = force.getReactionFieldDielectric();
  krf = std::pow(cutoff, -3) * (dielectric - 1) / (2 * dielectric + 1);
  crf = 1 / cutoff * 3 * dielectric / (2 * dielectric + 1);
}

double PairPotential::coulombConstant() { return ONE_4PI_EPS0; }

PairTerms PairPotential::ofParticles(const DCHParameterSet::Particle& a, const DCHParameterSet::Particle& b,
                                     double r2) const {
  if (cutoff > 0 && r2 >= cutoff * cutoff) return {};
  PairTerms terms = lennardJones(0.5 * (a.sigma + b.sigma), std::sqrt(a.epsilon * b.epsilon), r2);
  const double r = std::sqrt(r2);
  if (switched && r > switchFrom) {
    const double t = (r - switchFrom) / (cutoff - switchFrom);
    const double value = 1 + t * t * t * (-10 + t * (15 - t * 6));
    const double slope = t * t * (-30 + t * (60 - t * 30)) / (cutoff - switchFrom);
    terms.forceOverR = value * terms.forceOverR - slope * terms.energy / r;
    terms.energy *= value;
  }
  if (const double charges = coulombConstant() * a.charge * b.charge; charges != 0) {
    const double near = std::erfc(alpha * r) / r;
    terms.energy += charges * (near + krf * r2 - crf);
    terms.forceOverR += charges * ((near + gaussian(r2)) / r2 - 2 * krf);
  }
  return terms;
}

/// 2 splitting / sqrt(pi) e^-(splitting r)^2
double PairPotential::gaussian(double r2) const {
  return 2 * alpha / std::sqrt(PI_M) * std::exp(-alpha * alpha * r2);
}

PairTerms PairPotential::inReciprocalSpace(double chargeProd, double r2) const {
  const double charges = coulombConstant() * chargeProd, r = std::sqrt(r2);
  // Where particles coincide there is an energy, and no force.
  if (r2 == 0) return {charges * gaussian(0), 0};
  const double far = std::erf(alpha * r) / r;
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
