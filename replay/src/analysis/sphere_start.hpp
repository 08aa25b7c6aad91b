// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "input/sphere_state.hpp"

namespace dch::cli {

/// A kind of spheres.
struct SphereSize {
  double diameter = 1;  ///< > 0 [length]
  double share = 1;     ///< of the number of all spheres, over the sum of all shares
};

enum class SphereStart { lattice, random };

struct StartOptions {
  std::int64_t spheres = 0;
  double fraction = 0;  ///< of the box that they fill
  std::vector<SphereSize> sizes = {{}};
  SphereStart start = SphereStart::lattice;
  std::uint64_t seed = 1;
  double growth = 0.1;  ///< in a unit of time, of the radii to come, where they have to grow
};

struct StartResult {
  SphereState state;
  double fraction = 0;          ///< with which the spheres began to grow; that of `state` if they had not to
  std::int64_t collisions = 0;  ///< of the growth
};

/// Spheres on a face-centered cubic lattice or at random places in a cubic box; where they would overlap they
/// begin smaller, all in proportion, and grow. Masses are the cubes of diameters, velocities those of
/// temperature 1 (Boltzmann's constant is 1) with a sum of momenta of zero.
/// @throws UsageError where growth jams before the fraction is reached.
StartResult make_start(const StartOptions& options);

}  // namespace dch::cli
