// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene.hpp"

namespace dch::bench {
namespace {

constexpr double kDensity = 0.8442, kMeltRadius = 2.8;
/// In 10 steps of 0.005 at temperature 0.72 an atom moves about 0.042 along an axis; so does one that is
/// displaced evenly up to this.
constexpr double kMeltStep = 0.073;
constexpr std::uint64_t kSeed = 1;

Vec3 random_in_cube(std::mt19937_64& engine, double side) {
  const double x = uniform(engine), y = uniform(engine), z = uniform(engine);
  return {side * x, side * y, side * z};
}

Vec3 random_direction(std::mt19937_64& engine) {
  for (;;) {
    const Vec3 v = random_in_cube(engine, 2) - Vec3{1, 1, 1};
    const double square = norm2(v);
    if (square > 1e-4 && square < 1) return (1 / std::sqrt(square)) * v;
  }
}

Vec3 shaken(std::mt19937_64& engine, Vec3 p, double most) {
  return p + random_in_cube(engine, 2 * most) - Vec3{most, most, most};
}

double ball_volume(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

}  // namespace

std::unique_ptr<RandomScene> make_shaken_lattice(double atoms, double list_radius) {
  auto scene = std::make_unique<RandomScene>(kSeed);
  std::mt19937_64 engine(kSeed);
  const auto side = static_cast<int>(std::lround(std::cbrt(atoms)));
  const double spacing = std::cbrt(1 / kDensity);
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z)
        scene->positions.push_back(shaken(engine, {spacing * x, spacing * y, spacing * z}, 0.3 * spacing));
  scene->box = Box::orthorhombic({spacing * side, spacing * side, spacing * side});
  scene->list_radii = {list_radius};
  scene->step_length = kMeltStep;
  scene->origin = "a shaken lattice, moved at random";
  scene->start();
  return scene;
}

std::unique_ptr<RandomScene> make_droplet(double scale, double gas_atoms) {
  auto scene = std::make_unique<RandomScene>(kSeed);
  std::mt19937_64 engine(kSeed);
  const double spacing = std::cbrt(1 / kDensity),
               radius = std::cbrt(30000 * scale / ball_volume(1) / kDensity);
  const double width = 200 * radius;
  const Vec3 middle{width / 2, width / 2, width / 2};
  const int reach = static_cast<int>(radius / spacing) + 1;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z) {
        const Vec3 at{spacing * x, spacing * y, spacing * z};
        if (norm2(at) <= radius * radius)
          scene->positions.push_back(middle + shaken(engine, at, 0.3 * spacing));
      }
  scene->drift.assign(scene->positions.size(), Vec3{});
  const double flight = kMeltStep;  // about sqrt(3 T) times 10 steps
  for (int k = 0; k < static_cast<int>(gas_atoms * scale); ++k) {
    scene->positions.push_back(random_in_cube(engine, width));
    scene->drift.push_back(flight * random_direction(engine));
  }
  scene->box = Box::orthorhombic({width, width, width});
  scene->list_radii = {kMeltRadius};
  scene->step_length = kMeltStep;
  scene->origin = "liquid droplet in a box 100 times as wide, moved at random";
  scene->start();
  return scene;
}

std::unique_ptr<RandomScene> make_power_law_clusters(double scale) {
  constexpr int kLevels = 5, kPerCluster = 6;
  constexpr double kShrink = 2.2;  // of radii from level to level: fractal dimension ln 6 / ln 2.2 = 2.3
  constexpr double kFinest = 1.5;  // radius of the smallest clusters
  auto scene = std::make_unique<RandomScene>(kSeed);
  std::mt19937_64 engine(kSeed);
  const double largest = kFinest * std::pow(kShrink, kLevels - 1), width = 10 * largest;
  const int clusters =
      std::max(1, static_cast<int>(std::lround(32000 * scale / std::pow(kPerCluster, kLevels))));
  std::vector<Vec3> centers;
  for (int k = 0; k < clusters; ++k) centers.push_back(random_in_cube(engine, width));
  for (double radius = largest; radius > 0.99 * kFinest; radius /= kShrink) {
    std::vector<Vec3> finer;
    for (const Vec3& center : centers)
      for (int k = 0; k < kPerCluster; ++k)
        finer.push_back(center + (radius * std::cbrt(uniform(engine))) * random_direction(engine));
    centers.swap(finer);
  }
  scene->positions = std::move(centers);
  scene->box = Box::orthorhombic({width, width, width});
  scene->list_radii = {kMeltRadius};
  scene->step_length = kMeltStep;
  scene->origin = "clusters of clusters, dimension 2.3, moved at random";
  scene->start();
  return scene;
}

}  // namespace dch::bench
