// SPDX-License-Identifier: MIT
//
// Scenes that are hard for one thing that lists rest on: a chain that is thin everywhere, a box that changes,
// atoms that hardly move, atoms that fly.
#include <algorithm>
#include <cmath>
#include <vector>

#include <dch/necklace/walks.hpp>

#include "scene.hpp"

namespace dch::bench {
namespace {

constexpr std::uint64_t kDrivenSeed = 1;
constexpr double kDrivenRadius = 2.8;
/// Time between two configurations in reduced units: 10 steps of 0.005.
constexpr double kTime = 0.05;

/// From a normal distribution of variance 1, nearly: the sum of twelve uniform numbers; the same everywhere.
double normal(std::mt19937_64& engine) {
  double sum = -6;
  for (int k = 0; k < 12; ++k) sum += uniform(engine);
  return sum;
}

}  // namespace

std::unique_ptr<RandomScene> make_swollen_chain(double scale) {
  constexpr double kListRadius = 1.52, kDiameter = 0.9;
  auto scene = std::make_unique<RandomScene>(kDrivenSeed);
  const auto beads = static_cast<std::int32_t>(20000 * scale);
  scene->positions = necklace::self_avoiding_walk(beads, kDiameter, kDrivenSeed).positions;
  Vec3 low = scene->positions.front(), high = low;
  for (const Vec3& p : scene->positions)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  const Vec3 extent = high - low;
  const double width = 2 * std::max({extent.x, extent.y, extent.z});
  const Vec3 to_middle = Vec3{width / 2, width / 2, width / 2} - 0.5 * (low + high);
  for (Vec3& p : scene->positions) p = p + to_middle;
  std::vector<IndexPair> bonds;
  for (std::int32_t i = 1; i < beads; ++i) bonds.push_back({i - 1, i});
  scene->exclusions = Exclusions::from_bonds(scene->positions.size(), bonds, 1);
  scene->box = Box::orthorhombic({width, width, width});
  scene->list_radii = {kListRadius};
  scene->step_length = 0.073;  // as in the melt
  scene->origin = "a self-avoiding walk in a box twice as wide, moved at random";
  scene->start();
  return scene;
}

std::unique_ptr<RandomScene> make_sheared_lattice(double scale) {
  auto scene = make_shaken_lattice(32000 * scale, kDrivenRadius);
  scene->strain = 1.0 / 40;                     // a rate of 0.5
  const double width = scene->box.vector(0).x;  // tilted from the first configuration on
  scene->box = Box::triclinic({width, 0, 0}, {width / 4, width, 0}, {0, 0, width});
  scene->start();
  scene->origin = "a shaken lattice, moved at random and sheared, the box with it";
  return scene;
}

std::unique_ptr<RandomScene> make_glass(double scale) {
  auto scene = make_shaken_lattice(32000 * scale, kDrivenRadius);
  // Evenly up to this has the mean square T/k of an oscillator at T = 0.1 with k = 250, about that of an atom
  // in a Lennard-Jones solid of this density.
  scene->step_length = std::sqrt(3 * 0.1 / 250);
  scene->tethered = true;
  scene->origin = "a shaken lattice, vibrating as at temperature 0.1";
  return scene;
}

std::unique_ptr<RandomScene> make_hot_gas(double scale) {
  constexpr double kDensity = 0.05, kTemperature = 10;
  auto scene = std::make_unique<RandomScene>(kDrivenSeed);
  std::mt19937_64 engine(kDrivenSeed);
  const auto atoms = static_cast<std::size_t>(32000 * scale);
  const double width = std::cbrt(static_cast<double>(atoms) / kDensity);
  const double flight = kTime * std::sqrt(kTemperature);
  for (std::size_t k = 0; k < atoms; ++k) {
    const double x = uniform(engine), y = uniform(engine), z = uniform(engine);
    scene->positions.push_back({width * x, width * y, width * z});
    const double u = normal(engine), v = normal(engine), w = normal(engine);
    scene->drift.push_back({flight * u, flight * v, flight * w});
  }
  scene->box = Box::orthorhombic({width, width, width});
  scene->list_radii = {kDrivenRadius};
  scene->origin = "atoms of density 0.05 that fly as at temperature 10";
  scene->start();
  return scene;
}

}  // namespace dch::bench
