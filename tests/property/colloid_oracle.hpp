// SPDX-License-Identifier: MIT
//
// Energies of spheres made of Lennard-Jones particles: Everaers and Ejtehadi, Phys. Rev. E 67, 041710 (2003).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <dch/forces/pair_potential.hpp>

#include "dual.hpp"

namespace dch::forms {

inline Dual power(Dual x, int n) {
  Dual product = 1;
  for (int k = 0; k < n; ++k) product = product * x;
  return product;
}

/// Of spheres of radii a and b.
inline Dual energy_of_spheres(double hamaker, double sigma, double a, double b, Dual r) {
  const Dual sum2 = (a + b) * (a + b), less2 = (a - b) * (a - b), u = r * r - sum2, v = r * r - less2;
  const Dual attraction = -hamaker / 6 * (2 * a * b / u + 2 * a * b / v + log(u / v));
  const double squares = a * a + b * b, product = 7 * a * b;
  const Dual near = (r * r - 7 * (a + b) * r + 6 * (squares + product)) / power(r - (a + b), 7),
             far = (r * r + 7 * (a + b) * r + 6 * (squares + product)) / power(r + (a + b), 7),
             first = (r * r + 7 * (a - b) * r + 6 * (squares - product)) / power(r + (a - b), 7),
             second = (r * r - 7 * (a - b) * r + 6 * (squares - product)) / power(r - (a - b), 7);
  return attraction + hamaker / 37800 * std::pow(sigma, 6) / r * (near + far - first - second);
}

/// Of a sphere of the radius a and a particle.
inline Dual energy_of_sphere(double hamaker, double sigma, double a, Dual r) {
  const Dual x = r * r, t = a * a - x;
  const Dual inner = 5 * std::pow(a, 6) + 45 * std::pow(a, 4) * x + 63 * a * a * x * x + 15 * x * x * x;
  const Dual repulsion = inner * std::pow(sigma, 6) / (15 * power(a - r, 6) * power(a + r, 6));
  return 2 * std::pow(a, 3) * std::pow(sigma, 3) * hamaker / (9 * power(t, 3)) * (1 - repulsion);
}

/// @param n  as PairForm::colloid has them
inline Dual energy_of_colloids(const std::array<double, 4>& n, Dual r) {
  const double a = n[2] / 2, b = n[3] / 2;
  if (a > 0 && b > 0) return energy_of_spheres(n[0], n[1], a, b, r);
  if (a > 0 || b > 0) return energy_of_sphere(n[0], n[1], std::max(a, b), r);
  const Dual s6 = power(n[1] / r, 6);
  return n[0] / 36 * (s6 * s6 - s6);
}

/// Particles of a solvent, and spheres of two sizes that may come as near to each other as points of Scene
/// do.
inline PairPotentialParams with_diameters(PairPotentialParams all) {
  constexpr double kDiameter[] = {0, 0.5, 0.7};
  for (int a = 0; a < all.types; ++a)
    for (int b = 0; b < all.types; ++b) {
      auto& numbers = all.pairs[static_cast<std::size_t>(a * all.types + b)].numbers;
      numbers[1] -= 0.05 * (a + b);
      numbers[2] = kDiameter[std::min(a, b) % 3];
      numbers[3] = kDiameter[std::max(a, b) % 3];
    }
  return all;
}

}  // namespace dch::forms
