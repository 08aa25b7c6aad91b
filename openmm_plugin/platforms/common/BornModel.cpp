// SPDX-License-Identifier: MIT
#include "BornModel.h"

#include <algorithm>
#include <cmath>

#include "internal/DCHNonbondedChecks.h"

namespace OpenMMDCH {
namespace {

constexpr double kProbeRadius = 0.14;  // of a molecule of water [nm]

std::string faultOf(const BornModel::Particle& p) {
  if (!(std::isfinite(p.offsetRadius) && p.offsetRadius > 0))
    return "the radius less the offset is " + textOf(p.offsetRadius) + " nm, and has to be positive";
  for (const double number : {p.charge, p.scaledRadius, p.alpha, p.beta, p.gamma})
    if (!std::isfinite(number)) return "a parameter is " + textOf(number);
  return "";
}

/// H and dH/dr of dch/forces/generalized_born.hpp, from the difference of its limits: its terms cancel.
ValueAndSlope descreening(double r, double a, double s, bool countsInside) {
  const double most = r + s, least = std::max(a, std::abs(r - s));
  if (a >= most) return {};
  const double across = std::min(s - a + r, 2 * std::min(r, s)), both = least + most;
  const double over = 1 / (least * most), halfLog = std::atanh(across / both);
  ValueAndSlope h;
  h.value = 0.5 * (across * over * (1 - 0.25 * (r - s) * both / (least * r)) - halfLog / r);
  h.slope = -(0.125 * (r * r + s * s) * across * both * over * over - 0.5 * halfLog) / (r * r);
  if (a < s - r) {
    if (countsInside)
      h.value += 1 / a - 1 / least;
    else
      h.slope += 1 / (least * least);
  }
  return h;
}

ValueAndSlope neck(double r, double at, double height) {
  const double x = r - at, x2 = x * x, x4 = x2 * x2;
  const double bottom = 1 + 100 * x2 + 0.3e6 * x4 * x2;
  return {height / bottom, -height * (200 * x + 1.8e6 * x4 * x) / (bottom * bottom)};
}

}  // namespace

std::string faultOf(const BornModel& model) {
  for (std::size_t i = 0; i < model.particles.size(); ++i) {
    std::string fault = faultOf(model.particles[i]);
    const int kind = model.particles[i].kind;
    if (fault.empty() && model.necks.kinds > 0 && (kind < 0 || kind >= model.necks.kinds))
      fault = "its index of radius is not one of the table";
    if (!fault.empty()) return "particle " + std::to_string(i) + " has no Born radius: " + fault;
  }
  return "";
}

ValueAndSlope bornRadius(const BornModel& model, const BornModel::Particle& p, double integral) {
  const double a = p.offsetRadius;
  if (model.hct) {
    const double b = 1 / (1 / a - integral);
    return {b, b * b};
  }
  const double psi = integral * a;
  const double bend = std::tanh(psi * (p.alpha + psi * (-p.beta + psi * p.gamma)));
  const double b = 1 / (1 / a - bend / p.radius);
  const double slope = (1 - bend * bend) * (p.alpha + psi * (-2 * p.beta + psi * 3 * p.gamma));
  return {b, b * b * slope * a / p.radius};
}

ValueAndSlope energyOfParticle(const BornModel& model, const BornModel::Particle& p, double b) {
  const dch::BornEnergy& e = model.energy;
  const double salt = e.over_solvent * std::exp(-e.kappa * b), screened = e.over_solute - salt;
  const double half = 0.5 * e.constant * p.charge * p.charge / b;
  ValueAndSlope all{-half * screened, half * (screened / b - e.kappa * salt)};
  if (b > 0 || !model.countsInside) {  // GBSAOBCForce leaves the others out
    const double reach = p.radius + kProbeRadius;
    const double surface = model.surface * reach * reach * std::pow(p.radius / b, 6);
    all.value += surface;
    all.slope -= 6 * surface / b;
  }
  return all;
}

ValueAndSlope integralOfPair(const BornModel& model, const BornModel::Particle& particle,
                             const BornModel::Particle& other, double distance) {
  constexpr double kLeast = 1e-6;  // [nm]
  const double r = std::max(distance, kLeast);
  ValueAndSlope all = descreening(r, particle.offsetRadius, other.scaledRadius, model.countsInside);
  const dch::BornNecks& necks = model.necks;
  if (necks.kinds == 0 || r > particle.offsetRadius + other.offsetRadius + necks.reach) return all;
  const std::size_t k = static_cast<std::size_t>(particle.kind) * static_cast<std::size_t>(necks.kinds) +
                        static_cast<std::size_t>(other.kind);
  const ValueAndSlope more = neck(r, necks.at[k], necks.height[k]);
  return {all.value + necks.scale * more.value, all.slope + necks.scale * more.slope};
}

BornPairTerms energyOfPair(const dch::BornEnergy& energy, double charges, double bornRadii, double r2) {
  const double depth = r2 / (4 * bornRadii), gauss = std::exp(-depth);
  const double f2 = r2 + bornRadii * gauss, f = std::sqrt(f2), rest = 1 / f - energy.shift;
  const double salt = energy.over_solvent * std::exp(-energy.kappa * f), screened = energy.over_solute - salt;
  const double scale = energy.constant * charges;
  const double slopeOverF = scale * (screened / f2 - energy.kappa * salt * rest) / f;  // (dE/df) / f
  return {-scale * screened * rest, -slopeOverF * (1 - 0.25 * gauss),
          0.5 * slopeOverF * bornRadii * gauss * (1 + depth)};
}

}  // namespace OpenMMDCH
