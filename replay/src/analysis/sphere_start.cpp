// SPDX-License-Identifier: MIT
#include "analysis/sphere_start.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <random>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/kinetic/sphere_growth.hpp>
#include <dch/proximity/closest_pair.hpp>

#include "options/option_values.hpp"

namespace dch::cli {
namespace {

/// Beyond this pressure, over that of an ideal gas, spheres that grow are taken to be jammed.
constexpr double kJammed = 1e4;
/// Spheres that touch at the start are a little smaller: rounding may have them overlap.
constexpr double kApart = 1 - 1e-9;

/// The same numbers with every standard library: it specifies the engine, not the distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }
  Vec3 normal_vector() {
    const double x = normal(), y = normal();
    return {x, y, normal()};
  }
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t k = items.size(); k > 1; --k)
      std::swap(items[k - 1], items[static_cast<std::size_t>(uniform() * static_cast<double>(k))]);
  }

 private:
  std::mt19937_64 engine_;
};

std::vector<double> radii_of(const StartOptions& options) {
  double all = 0;
  for (const SphereSize& size : options.sizes) all += size.share;
  std::vector<double> radii;
  double share = 0;
  for (const SphereSize& size : options.sizes) {
    share += size.share;
    radii.resize(static_cast<std::size_t>(std::llround(share / all * static_cast<double>(options.spheres))),
                 0.5 * size.diameter);
  }
  return radii;
}

std::vector<Vec3> lattice(std::size_t spheres, double edge, Random& random) {
  const auto side = static_cast<std::int64_t>(std::ceil(std::cbrt(static_cast<double>(spheres) / 4 - 1e-9)));
  const double spacing = edge / static_cast<double>(side), quarter = 0.25 * spacing, half = 0.5 * spacing;
  std::vector<Vec3> sites;
  for (std::int64_t k = 0; k < side * side * side; ++k) {
    const std::int64_t x = k % side, y = k / side % side, z = k / side / side;
    const Vec3 corner{spacing * static_cast<double>(x) + quarter, spacing * static_cast<double>(y) + quarter,
                      spacing * static_cast<double>(z) + quarter};
    for (const Vec3 face : {Vec3{}, Vec3{0, half, half}, Vec3{half, 0, half}, Vec3{half, half, 0}})
      sites.push_back(corner + face);
  }
  random.shuffle(sites);
  sites.resize(spheres);
  return sites;
}

std::vector<Vec3> random_places(std::size_t spheres, double edge, Random& random) {
  std::vector<Vec3> places;
  for (std::size_t k = 0; k < spheres; ++k) {
    const double x = random.uniform(), y = random.uniform();
    places.push_back(edge * Vec3{x, y, random.uniform()});
  }
  return places;
}

void draw_velocities(SphereState& state, Random& random) {
  state.velocities.clear();
  Vec3 momentum;
  double mass = 0;
  for (const double m : state.masses) {
    state.velocities.push_back((1 / std::sqrt(m)) * random.normal_vector());
    momentum = momentum + m * state.velocities.back();
    mass += m;
  }
  if (state.masses.size() < 2) return;
  for (Vec3& v : state.velocities) v = v - (1 / mass) * momentum;
}

/// What all radii are to be multiplied by so that no two spheres overlap.
double scale_without_overlap(const SphereState& state) {
  if (state.radii.size() < 2) return 1;
  HierarchyParams params;
  params.radius = 0.1 * state.edge;
  Hierarchy hierarchy(params);
  hierarchy.build(state.positions, state.box());
  const double distance = std::sqrt(closest_pair(PointTree(hierarchy.view())).distance2);
  return std::min(1.0, kApart * distance / (2 * *std::max_element(state.radii.begin(), state.radii.end())));
}

/// The radii become what they are, and so do the places.
std::int64_t let_grow(SphereState& state, double scale, const StartOptions& options) {
  kinetic::HardSphereParams params{state.box(), state.radii, state.masses, 1};
  for (double& radius : params.radii) radius *= scale;
  kinetic::HardSpheres spheres(params, state.positions, state.velocities);
  const kinetic::GrowthResult grown =
      kinetic::grow(spheres, {options.growth / scale, options.fraction, kJammed});
  if (grown.is_jammed)
    throw UsageError(
        fmt::format("--fraction {}: spheres that grew by --growth {} jammed at {:.6f}; choose a "
                    "lower fraction or a slower growth",
                    options.fraction, options.growth, grown.fraction));
  for (std::size_t k = 0; k < state.positions.size(); ++k)
    state.positions[k] = spheres.position(static_cast<std::int32_t>(k));
  return spheres.counters().collisions;
}

}  // namespace

StartResult make_start(const StartOptions& options) {
  Random random(options.seed);
  StartResult result;
  SphereState& state = result.state;
  state.radii = radii_of(options);
  double volume = 0;
  for (const double radius : state.radii) {
    volume += 4 * std::numbers::pi / 3 * radius * radius * radius;
    state.masses.push_back(8 * radius * radius * radius);
  }
  state.edge = std::cbrt(volume / options.fraction);
  state.positions = options.start == SphereStart::lattice
                        ? lattice(state.radii.size(), state.edge, random)
                        : random_places(state.radii.size(), state.edge, random);
  draw_velocities(state, random);
  const double scale = scale_without_overlap(state);
  result.fraction = scale * scale * scale * options.fraction;
  if (scale < 1) {
    result.collisions = let_grow(state, scale, options);
    // Walls that grow give more energy to slow spheres than to fast ones.
    draw_velocities(state, random);
  }
  return result;
}

}  // namespace dch::cli
