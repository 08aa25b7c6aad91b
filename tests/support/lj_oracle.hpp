// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <dch/box.hpp>
#include <dch/exclusions.hpp>
#include <dch/lennard_jones.hpp>

namespace dch {

struct LennardJonesResult {
  std::vector<Vec3> force;
  LennardJonesSums sums;
};

/// Lennard-Jones forces by looking at all pairs, in plain double, with nearest images. `types` may be empty.
inline LennardJonesResult all_pairs_lennard_jones(const std::vector<Vec3>& positions, const Box& box,
                                                  const std::vector<LennardJonesPair>& matrix, bool shifted,
                                                  const std::vector<std::int32_t>& types = {},
                                                  const Exclusions* exclusions = nullptr,
                                                  std::int32_t first_ghost = -1) {
  LennardJonesResult result;
  result.force.resize(positions.size());
  const auto type_count =
      static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(matrix.size()))));
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (std::size_t j = i + 1; j < positions.size(); ++j) {
      const auto a = static_cast<std::int32_t>(i), b = static_cast<std::int32_t>(j);
      if (exclusions != nullptr && exclusions->excluded(a, b)) continue;
      if (first_ghost >= 0 && a >= first_ghost && b >= first_ghost) continue;
      const LennardJonesPair& pair =
          types.empty()
              ? matrix[0]
              : matrix[static_cast<std::size_t>(types[i]) * type_count + static_cast<std::size_t>(types[j])];
      const Vec3 d = box.nearest_image(positions[j] - positions[i]);
      const double r2 = norm2(d);
      if (r2 >= pair.cutoff * pair.cutoff) continue;
      const auto energy_at = [&](double distance2) {
        const double s6 = std::pow(pair.sigma * pair.sigma / distance2, 3);
        return 4 * pair.epsilon * (s6 * s6 - s6);
      };
      const double s6 = std::pow(pair.sigma * pair.sigma / r2, 3);
      const Vec3 f = 24 * pair.epsilon * (2 * s6 * s6 - s6) / r2 * d;  // on j
      result.force[j] = result.force[j] + f;
      result.force[i] = result.force[i] - f;
      result.sums.energy += energy_at(r2) - (shifted ? energy_at(pair.cutoff * pair.cutoff) : 0);
      const double virial[6] = {d.x * f.x, d.y * f.y, d.z * f.z, d.x * f.y, d.x * f.z, d.y * f.z};
      for (std::size_t k = 0; k < 6; ++k) result.sums.virial[k] += virial[k];
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
