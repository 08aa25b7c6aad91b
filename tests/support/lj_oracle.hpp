// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <dch/forces/lennard_jones.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>

namespace dch {

struct LennardJonesResult {
  std::vector<Vec3> force;
  LennardJonesSums sums;
};

/// Charges and how they act; no term: not at all.
struct OracleCharges {
  const CoulombTerm* term = nullptr;
  std::vector<double> charges;
};

/// Force times distance, and energy, of two charges.
struct ChargePair {
  double force_r = 0, energy = 0;
};

inline ChargePair charge_pair(const CoulombTerm& term, double qq, double r) {
  const double bare = term.constant * qq / r;
  if (term.splitting == 0) return {bare, bare};
  const double x = term.splitting * r, e = std::exp(-x * x), t = 1 / (1 + 0.3275911 * x);
  const double erfc =
      t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429)))) * e;
  return {bare * (erfc + 1.12837917 * x * e), bare * erfc};
}

/// Forces by looking at all pairs, in plain double, with nearest images. `types` may be empty.
inline LennardJonesResult all_pairs_lennard_jones(const std::vector<Vec3>& positions, const Box& box,
                                                  const std::vector<LennardJonesPair>& matrix, bool shifted,
                                                  const std::vector<std::int32_t>& types = {},
                                                  const Exclusions* exclusions = nullptr,
                                                  std::int32_t first_ghost = -1,
                                                  const OracleCharges& of_charges = {}) {
  LennardJonesResult result;
  result.force.resize(positions.size());
  const auto type_count =
      static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(matrix.size()))));
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (std::size_t j = i + 1; j < positions.size(); ++j) {
      const auto a = static_cast<std::int32_t>(i), b = static_cast<std::int32_t>(j);
      if (exclusions != nullptr && exclusions->excluded(a, b)) continue;
      if (first_ghost >= 0 && a >= first_ghost && b >= first_ghost) continue;
      const std::size_t of_types = types.empty() ? 0
                                                 : static_cast<std::size_t>(types[i]) * type_count +
                                                       static_cast<std::size_t>(types[j]);
      const LennardJonesPair& pair = matrix[of_types];
      const Vec3 d = box.nearest_image(positions[j] - positions[i]);
      const double r2 = norm2(d);
      const auto act = [&](double force_over_r) {
        const Vec3 f = force_over_r * d;  // on j
        result.force[j] = result.force[j] + f;
        result.force[i] = result.force[i] - f;
        const double virial[6] = {d.x * f.x, d.y * f.y, d.z * f.z, d.x * f.y, d.x * f.z, d.y * f.z};
        for (std::size_t k = 0; k < 6; ++k) result.sums.virial[k] += virial[k];
      };
      if (const CoulombTerm* term = of_charges.term;
          term && r2 < term->cutoffs[of_types] * term->cutoffs[of_types]) {
        const ChargePair charges =
            charge_pair(*term, of_charges.charges[i] * of_charges.charges[j], std::sqrt(r2));
        act(charges.force_r / r2);
        result.sums.coulomb_energy += charges.energy;
      }
      if (r2 >= pair.cutoff * pair.cutoff) continue;
      const auto energy_at = [&](double distance2) {
        const double s6 = std::pow(pair.sigma * pair.sigma / distance2, 3);
        return 4 * pair.epsilon * (s6 * s6 - s6);
      };
      const double s6 = std::pow(pair.sigma * pair.sigma / r2, 3);
      act(24 * pair.epsilon * (2 * s6 * s6 - s6) / r2);
      result.sums.energy += energy_at(r2) - (shifted ? energy_at(pair.cutoff * pair.cutoff) : 0);
    }
  return result;
}

/// Root mean square difference of forces, over the root mean square of `expected`.
inline double force_error(const std::vector<Vec3>& forces, const std::vector<Vec3>& expected) {
  double error2 = 0, size2 = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    error2 += norm2(forces[i] - expected[i]);
    size2 += norm2(expected[i]);
  }
  return size2 > 0 ? std::sqrt(error2 / size2) : std::sqrt(error2);
}

}  // namespace dch
