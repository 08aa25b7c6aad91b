// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <utility>

#include "openmm_case.hpp"

namespace OpenMMDCH {

/// Energy of a pair of particles and -dE/dr, from the textbook's formulas.
struct RadialTerms {
  double energy = 0, force = 0;
};

inline RadialTerms lennard_jones(double sigma, double epsilon, double r) {
  const double s6 = std::pow(sigma / r, 6);
  return {4 * epsilon * (s6 * s6 - s6), 24 * epsilon * (2 * s6 * s6 - s6) / r};
}

/// What a lattice sum leaves of a charge product to pairs, or, with `far`, what reciprocal space holds of it.
inline RadialTerms ewald_terms(double qq, double splitting, double r, bool far) {
  const double x = splitting * r, gauss = 2 / std::sqrt(M_PI) * x * std::exp(-x * x);
  const double share = far ? std::erf(x) : std::erfc(x);
  return {qq * share / r, qq * (share + (far ? -gauss : gauss)) / (r * r)};
}

/// What reciprocal space holds of two coefficients of dispersion, but for its sign.
inline RadialTerms far_dispersion(double product, double splitting, double distance) {
  const long double r = distance, y = splitting * splitting * r * r;
  const long double shorter = 1 + y + y * y / 2, longer = shorter + y * y * y / 6;
  const long double energy = product * (1 - std::exp(-y) * shorter) / std::pow(r, 6.0L);
  return {static_cast<double>(energy),
          static_cast<double>(6 * product * (1 - std::exp(-y) * longer) / std::pow(r, 7.0L))};
}

/// Of lattice sums, 0 without one [1/nm].
struct OracleSplittings {
  double charges = 0, dispersion = 0;
};

inline double dispersion_coefficient(double sigma, double epsilon) {
  return 8 * std::pow(sigma / 2, 3) * 2 * std::sqrt(epsilon);
}

template <class Force>
RadialTerms pair_terms(const Force& force, int i, int j, double r, const OracleSplittings& splittings) {
  const double splitting = splittings.charges;
  double qi, si, ei, qj, sj, ej;
  force.getParticleParameters(i, qi, si, ei);
  force.getParticleParameters(j, qj, sj, ej);
  RadialTerms terms = lennard_jones((si + sj) / 2, std::sqrt(ei) * std::sqrt(ej), r);
  const double qq = kCoulomb * qi * qj;
  if (force.getNonbondedMethod() == Force::NoCutoff)
    return {terms.energy + qq / r, terms.force + qq / (r * r)};
  const double rc = force.getCutoffDistance(), rs = force.getSwitchingDistance();
  if (splittings.dispersion > 0) {
    const double product = dispersion_coefficient(si, ei) * dispersion_coefficient(sj, ej);
    const auto whole = [&](double at) {
      const RadialTerms near = lennard_jones((si + sj) / 2, std::sqrt(ei * ej), at);
      const RadialTerms far = far_dispersion(product, splittings.dispersion, at);
      return RadialTerms{near.energy + far.energy, near.force + far.force};
    };
    terms = {whole(r).energy - whole(rc).energy, whole(r).force};
  }
  if (force.getUseSwitchingFunction() && r > rs) {
    const double x = (r - rs) / (rc - rs);
    const double s = 1 - 10 * std::pow(x, 3) + 15 * std::pow(x, 4) - 6 * std::pow(x, 5);
    const double slope = (-30 * x * x + 60 * std::pow(x, 3) - 30 * std::pow(x, 4)) / (rc - rs);
    terms = {s * terms.energy, s * terms.force - slope * terms.energy};
  }
  if (splitting > 0) {
    const RadialTerms ewald = ewald_terms(qq, splitting, r, false);
    return {terms.energy + ewald.energy, terms.force + ewald.force};
  }
  const double e = force.getReactionFieldDielectric();
  const double k = (e - 1) / (2 * e + 1) / (rc * rc * rc), c = 3 * e / (2 * e + 1) / rc;
  return {terms.energy + qq * (1 / r + k * r * r - c), terms.force + qq * (1 / (r * r) - 2 * k * r)};
}

/// The image that OpenMM takes for the nearest one.
inline Vec3 wrapped(Vec3 apart, const Vec3* box) {
  // Boxes of OpenMM have vectors with ever more components: x, xy, xyz.
  for (int axis = 2; axis >= 0; --axis) apart -= box[axis] * std::floor(apart[axis] / box[axis][axis] + 0.5);
  return apart;
}

/// Calls act(d) for a displacement and, in a box (which may be null), for those of 27 images of it.
template <class F>
void for_each_image(const Vec3& apart, const Vec3* box, const F& act) {
  if (!box) return act(apart);
  const Vec3 near = wrapped(apart, box);
  for (int n = 0; n < 27; ++n)
    act(near + box[0] * (n % 3 - 1) + box[1] * (n / 3 % 3 - 1) + box[2] * (n / 9 - 1));
}

/// Energy and forces by all pairs of particles and all their images within the cutoff, and by all exceptions,
/// in plain double. The dispersion correction is left out. `box` may be null. With splittings it is the part
/// of lattice sums in direct space.
template <class Force>
Evaluation all_pairs(const Force& force, const std::vector<Vec3>& positions, const Vec3* box,
                     const OracleSplittings& splittings = {}) {
  Evaluation result{0, std::vector<Vec3>(positions.size())};
  const auto act = [&](std::size_t i, std::size_t j, const Vec3& apart, const RadialTerms& terms) {
    const Vec3 f = apart * (terms.force / std::sqrt(apart.dot(apart)));
    result.forces[j] += f;
    result.forces[i] -= f;
    result.energy += terms.energy;
    result.size += std::abs(terms.energy);
  };
  std::set<std::pair<int, int>> excluded;
  for (int k = 0; k < force.getNumExceptions(); ++k) {
    int i, j;
    double qq, sigma, epsilon;
    force.getExceptionParameters(k, i, j, qq, sigma, epsilon);
    excluded.insert({std::min(i, j), std::max(i, j)});
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    Vec3 apart = positions[b] - positions[a];
    if (box && force.getExceptionsUsePeriodicBoundaryConditions()) apart = wrapped(apart, box);
    const double r = std::sqrt(apart.dot(apart));
    RadialTerms terms = lennard_jones(sigma, epsilon, r);
    if (qq != 0 || epsilon != 0)
      act(a, b, apart, {terms.energy + kCoulomb * qq / r, terms.force + kCoulomb * qq / (r * r)});
    double qi, si, ei, qj, sj, ej;
    force.getParticleParameters(i, qi, si, ei);
    force.getParticleParameters(j, qj, sj, ej);
    if (splittings.charges > 0) {
      terms = ewald_terms(kCoulomb * qi * qj, splittings.charges, r, true);
      act(a, b, apart, {-terms.energy, -terms.force});
    }
    if (splittings.dispersion > 0)
      act(a, b, apart,
          far_dispersion(dispersion_coefficient(si, ei) * dispersion_coefficient(sj, ej),
                         splittings.dispersion, r));
  }
  const double cutoff = force.getNonbondedMethod() == Force::NoCutoff
                            ? std::numeric_limits<double>::infinity()
                            : force.getCutoffDistance();
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (std::size_t j = i + 1; j < positions.size(); ++j) {
      if (excluded.count({static_cast<int>(i), static_cast<int>(j)}) > 0) continue;
      const auto act_within_cutoff = [&](const Vec3& apart) {
        if (const double r2 = apart.dot(apart); r2 < cutoff * cutoff)
          act(i, j, apart,
              pair_terms(force, static_cast<int>(i), static_cast<int>(j), std::sqrt(r2), splittings));
      };
      for_each_image(positions[j] - positions[i], box, act_within_cutoff);
    }
  return result;
}

/// Root mean square difference of forces over the root mean square of the expected ones.
inline double force_error(const Evaluation& expected, const Evaluation& found) {
  double error2 = 0, size2 = 0;
  for (std::size_t i = 0; i < expected.forces.size(); ++i) {
    const Vec3 d = found.forces.at(i) - expected.forces[i];
    error2 += d.dot(d);
    size2 += expected.forces[i].dot(expected.forces[i]);
  }
  return std::sqrt(error2 / size2);
}

}  // namespace OpenMMDCH
