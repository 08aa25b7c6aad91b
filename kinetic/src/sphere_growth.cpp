// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>
#include <dch/kinetic/sphere_growth.hpp>

#include "base/describe.hpp"

namespace dch::kinetic {
namespace {

using detail::describe;

/// Pressure is measured, and velocities are scaled, after so many collisions for each sphere.
constexpr std::int64_t kCollisions = 16;

void check(const HardSpheres& spheres, const GrowthParams& params) {
  if (!(params.rate > 0 && params.rate <= kMaxMagnitude))
    throw InvalidParameter("rate of growth = " + describe(params.rate) + " is not above 0 and at most " +
                           describe(kMaxMagnitude) + "; choose another");
  if (!(params.fraction > 0 && params.fraction <= 1))
    throw InvalidParameter("fraction = " + describe(params.fraction) +
                           " is not above 0 and at most 1; it is a share of the box");
  if (!(params.most_pressure > 1))
    throw InvalidParameter("most_pressure = " + describe(params.most_pressure) +
                           " is not above 1, that of an ideal gas; choose a larger one");
  if (spheres.box().rank() < 3)
    throw InvalidParameter("the box, " + spheres.box().description() +
                           ", is not periodic in all directions, so that spheres would fly out of it; give "
                           "one that is");
  if (spheres.size() > 0 && !(spheres.energy() > 0))
    throw InvalidParameter("the energy of the spheres is 0, so that time has no scale; give them velocities");
}

}  // namespace

GrowthResult grow(HardSpheres& spheres, const GrowthParams& params) {
  check(spheres, params);
  const double volume = spheres.box().volume(), energy = spheres.energy();
  GrowthResult result{spheres.volume() / volume, 1, false};
  if (spheres.size() == 0 || result.fraction >= params.fraction) return result;
  const double end = spheres.now() + (std::cbrt(params.fraction / result.fraction) - 1) / params.rate;
  const std::int64_t chunk = kCollisions * static_cast<std::int64_t>(spheres.size());
  const double rate = params.rate * spheres.radius(0);
  while (spheres.now() < end && !result.is_jammed) {
    spheres.set_growth(rate / spheres.radius(0));
    const double from = spheres.now(), virial = spheres.virial(), energy_before = spheres.energy();
    for (std::int64_t k = 0; k < chunk && spheres.step(end); ++k) {
    }
    const double passed = spheres.now() - from, mean = 0.5 * (energy_before + spheres.energy());
    result.pressure = 1 + (spheres.virial() - virial) / (2 * mean * passed);
    result.is_jammed = spheres.now() < end && !(result.pressure <= params.most_pressure);
    spheres.scale_velocities(std::sqrt(energy / spheres.energy()));
  }
  spheres.set_growth(0);
  result.fraction = spheres.volume() / volume;
  return result;
}

}  // namespace dch::kinetic
