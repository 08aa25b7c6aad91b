// SPDX-License-Identifier: MIT
#pragma once

#include <dch/kinetic/hard_spheres.hpp>

#pragma GCC visibility push(default)
namespace dch::kinetic {

struct GrowthParams {
  double rate = 0.01;          ///< > 0: of the radii at the start of the growth [1/time]
  double fraction = 1;         ///< of the box that the spheres are to fill, within (0, 1]
  double most_pressure = 1e6;  ///< over that of an ideal gas, > 1: spheres beyond it are jammed
};

struct GrowthResult {
  double fraction = 0;     ///< of the box that the spheres fill
  double pressure = 0;     ///< over that of an ideal gas, when it was last measured
  bool is_jammed = false;  ///< it exceeded GrowthParams::most_pressure, and the growth was ended
};

/// Lets the radii grow at a constant rate until the spheres fill a share of their box or are jammed (B. D.
/// Lubachevsky and F. H. Stillinger, J. Stat. Phys. 60:561, 1990). Velocities are scaled to the energy of the
/// start now and then, and at the end. The slower the growth, the denser the spheres jam.
/// @throws InvalidParameter for values out of range, a box that is not periodic in all directions, and
/// spheres
///   that are all at rest; as HardSpheres::step().
GrowthResult grow(HardSpheres& spheres, const GrowthParams& params);

}  // namespace dch::kinetic
#pragma GCC visibility pop
