// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <unordered_map>

#include "scene.hpp"

namespace dch::bench {
namespace {

constexpr std::uint64_t kSizedSeed = 1;
/// Of the smallest spheres, whose diameter is the unit of length.
constexpr double kSmallest = 0.5;
/// Of volume, that large spheres take among small ones.
constexpr double kLargeFraction = 0.25;
/// Contacts stay listed while each sphere moves a quarter of this unit.
constexpr double kSkin = 0.5;
constexpr double kStep = 0.05;

double sphere_volume(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

/// Spheres placed one after the other at random in a periodic cube, the larger ones first, none overlapping.
/// Its cells are about `width` wide, which changes the time alone.
class Packing {
 public:
  Packing(double side, double width)
      : side_(side),
        cells_(std::max(1, static_cast<int>(side / width))),
        width_(side / cells_),
        box_(Box::orthorhombic({side, side, side})),
        engine_(kSizedSeed) {}

  /// A place at random for a sphere no larger than those before.
  Vec3 place(double radius) {
    for (;;) {
      const Vec3 p{side_ * uniform(engine_), side_ * uniform(engine_), side_ * uniform(engine_)};
      if (overlaps(p, radius)) continue;
      add(p, radius);
      return p;
    }
  }
  /// Whether a sphere, no larger than any before, overlaps one of them.
  bool overlaps(Vec3 p, double radius) const {
    const auto found = spheres_in_.find(key(cell(p.x), cell(p.y), cell(p.z)));
    if (found == spheres_in_.end()) return false;
    return std::any_of(found->second.begin(), found->second.end(), [&](std::int32_t k) {
      const Sphere& other = spheres_[static_cast<std::size_t>(k)];
      const double contact = radius + other.radius;
      return box_.distance2(p, other.center) < contact * contact;
    });
  }
  /// Notes a sphere in all cells where the center of one that overlaps it may lie.
  void add(Vec3 p, double radius) {
    const double reach = 2 * radius;
    const auto last = [&](double x) { return std::min(cell(x + reach), cell(x - reach) + cells_ - 1); };
    for (int x = cell(p.x - reach); x <= last(p.x); ++x)
      for (int y = cell(p.y - reach); y <= last(p.y); ++y)
        for (int z = cell(p.z - reach); z <= last(p.z); ++z)
          spheres_in_[key(x, y, z)].push_back(static_cast<std::int32_t>(spheres_.size()));
    spheres_.push_back({p, radius});
  }
  const Box& box() const { return box_; }

 private:
  struct Sphere {
    Vec3 center;
    double radius;
  };
  int cell(double x) const { return static_cast<int>(std::floor(x / width_)); }
  std::int64_t key(int x, int y, int z) const {
    const auto wrapped = [this](int c) { return std::int64_t{((c % cells_) + cells_) % cells_}; };
    return (wrapped(z) * cells_ + wrapped(y)) * cells_ + wrapped(x);
  }

  double side_;
  int cells_;
  double width_;
  Box box_;
  std::mt19937_64 engine_;
  std::vector<Sphere> spheres_;
  std::unordered_map<std::int64_t, std::vector<std::int32_t>> spheres_in_;
};

/// Coordinate `site` of a lattice, moved at random by at most `part` of the spacing.
double shaken(double site, double spacing, double part, std::mt19937_64& engine) {
  return spacing * (site + part * (2 * uniform(engine) - 1));
}

/// Large spheres on a shaken fcc lattice, four in each of cubes^3 cubes, so that many fit a small box without
/// overlap.
std::vector<Vec3> place_large(int cubes, double cube, std::mt19937_64& engine) {
  std::vector<Vec3> centers;
  const auto at = [&](double site) { return shaken(site, cube, 0.05, engine); };
  for (int k = 0; k < 4 * cubes * cubes * cubes; ++k) {
    const int site = k / 4, corner = k % 4;
    const double x = at(site % cubes + (corner == 1 || corner == 2 ? 0.5 : 0)),
                 y = at(site / cubes % cubes + (corner == 1 || corner == 3 ? 0.5 : 0)),
                 z = at(site / (cubes * cubes) + (corner == 2 || corner == 3 ? 0.5 : 0));
    centers.push_back({x, y, z});
  }
  return centers;
}

double width_of_cube(double large) { return std::cbrt(4 * sphere_volume(large) / kLargeFraction); }

std::unique_ptr<RandomScene> start_sized(std::unique_ptr<RandomScene> scene, const Box& box,
                                         std::string origin) {
  scene->box = box;
  scene->skin = kSkin;
  scene->step_length = kStep;
  scene->origin = std::move(origin);
  scene->start();
  return scene;
}

}  // namespace

std::unique_ptr<RandomScene> make_two_sizes(double scale, double ratio) {
  constexpr double kSmallFraction = 0.3;
  auto scene = std::make_unique<RandomScene>(kSizedSeed);
  std::mt19937_64 engine(kSizedSeed);
  const double large = ratio * kSmallest, cube = width_of_cube(large);
  const int cubes = std::max(1, static_cast<int>(std::lround(20 * std::cbrt(scale) / ratio)));
  const double side = cubes * cube;
  Packing packing(side, large);
  scene->positions = place_large(cubes, cube, engine);
  for (const Vec3 center : scene->positions) packing.add(center, large);
  // The small ones on a shaken lattice in what is left.
  const double density = kSmallFraction / (1 - kLargeFraction) / sphere_volume(kSmallest);
  const int sites = static_cast<int>(side * std::cbrt(density));
  const double spacing = side / sites;
  scene->radii.assign(scene->positions.size(), large);
  for (int x = 0; x < sites; ++x)
    for (int y = 0; y < sites; ++y)
      for (int z = 0; z < sites; ++z) {
        const double px = shaken(x, spacing, 0.2, engine), py = shaken(y, spacing, 0.2, engine),
                     pz = shaken(z, spacing, 0.2, engine);
        if (packing.overlaps({px, py, pz}, kSmallest)) continue;
        scene->positions.push_back({px, py, pz});
        scene->radii.push_back(kSmallest);
      }
  return start_sized(std::move(scene), packing.box(),
                     "large spheres of volume fraction 0.25 among small ones of 0.3, moved at random");
}

std::unique_ptr<RandomScene> make_colloids(double scale, double ratio) {
  constexpr int kSmallForEachLarge = 200;
  constexpr double kLayer = 1;
  auto scene = std::make_unique<RandomScene>(kSizedSeed);
  std::mt19937_64 engine(kSizedSeed);
  const double large = ratio * kSmallest, cube = width_of_cube(large);
  const int cubes = std::max(1, static_cast<int>(std::lround(8 * std::cbrt(scale))));
  const double side = cubes * cube;
  const std::vector<Vec3> centers = place_large(cubes, cube, engine);
  scene->positions = centers;
  scene->radii.assign(centers.size(), large);
  for (const Vec3 center : centers)
    for (int k = 0; k < kSmallForEachLarge; ++k) {
      // A direction at random, by its height and its angle about the axis.
      const double height = 2 * uniform(engine) - 1, angle = 2 * std::numbers::pi * uniform(engine);
      const double distance = large + kSmallest + kLayer * uniform(engine),
                   across = std::sqrt(1 - height * height);
      scene->positions.push_back(center +
                                 distance * Vec3{across * std::cos(angle), across * std::sin(angle), height});
      scene->radii.push_back(kSmallest);
    }
  return start_sized(
      std::move(scene), Box::orthorhombic({side, side, side}),
      "large spheres of volume fraction 0.25 with 200 small ones at the surface of each, moved at random");
}

std::unique_ptr<RandomScene> make_continuous_sizes(double scale, double ratio) {
  constexpr double kFraction = 0.5;
  auto scene = std::make_unique<RandomScene>(kSizedSeed);
  const int count = static_cast<int>(30000 * scale);
  double volume = 0;
  for (int k = 0; k < count; ++k) {
    // The quantiles of a density that falls as the fourth power of the radius, the largest first.
    const double above = (k + 0.5) / count;
    const double radius = kSmallest / std::cbrt(1 - (1 - above) * (1 - 1 / (ratio * ratio * ratio)));
    scene->radii.push_back(radius);
    volume += sphere_volume(radius);
  }
  Packing packing(std::cbrt(volume / kFraction), 4 * kSmallest);
  for (const double radius : scene->radii) scene->positions.push_back(packing.place(radius));
  return start_sized(
      std::move(scene), packing.box(),
      "spheres of volume fraction 0.5, densities of numbers falling as the fourth power of the radius, "
      "moved at random");
}

}  // namespace dch::bench
