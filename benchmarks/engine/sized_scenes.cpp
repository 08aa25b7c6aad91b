// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>

#include "scene.hpp"

namespace dch::bench {
namespace {

constexpr std::uint64_t kSeed = 1;
/// Of the smallest spheres, whose diameter is the unit of length.
constexpr double kSmallest = 0.5;
/// Contacts stay listed while each sphere moves a quarter of this unit.
constexpr double kSkin = 0.5;
constexpr double kStep = 0.05;

double sphere_volume(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

/// Spheres placed one after the other at random in a periodic cube, the larger ones first, none overlapping.
class Packing {
 public:
  explicit Packing(double side)
      : side_(side),
        cells_(std::max(1, static_cast<int>(side / (4 * kSmallest)))),
        width_(side / cells_),
        engine_(kSeed) {}

  Vec3 place(double radius) {
    for (;;) {
      const Vec3 p{side_ * uniform(engine_), side_ * uniform(engine_), side_ * uniform(engine_)};
      if (!is_free(p, radius)) continue;
      add(p, radius);
      return p;
    }
  }
  /// Whether a sphere, no larger than any before, overlaps none of them.
  bool is_free(Vec3 p, double radius) const {
    const auto found = spheres_in_.find(key(cell(p.x), cell(p.y), cell(p.z)));
    if (found == spheres_in_.end()) return true;
    return std::none_of(found->second.begin(), found->second.end(), [&](std::int32_t k) {
      const Sphere& other = spheres_[static_cast<std::size_t>(k)];
      const double contact = radius + other.radius;
      return box().distance2(p, other.center) < contact * contact;
    });
  }
  Box box() const { return Box::orthorhombic({side_, side_, side_}); }

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

  double side_;
  int cells_;
  double width_;
  std::mt19937_64 engine_;
  std::vector<Sphere> spheres_;
  std::unordered_map<std::int64_t, std::vector<std::int32_t>> spheres_in_;
};

}  // namespace

std::unique_ptr<RandomScene> make_two_sizes(double scale, double ratio) {
  constexpr double kLargeFraction = 0.2, kSmallFraction = 0.15;
  auto scene = std::make_unique<RandomScene>(kSeed);
  const double large = ratio * kSmallest;
  // The box has to be wider than two contact distances of large spheres, which four of them allow.
  const int large_count = std::max(4, static_cast<int>(std::lround(40000 * scale / (ratio * ratio * ratio))));
  const double volume = large_count * sphere_volume(large) / kLargeFraction, side = std::cbrt(volume);
  Packing packing(side);
  for (int k = 0; k < large_count; ++k) {
    scene->positions.push_back(packing.place(large));
    scene->radii.push_back(large);
  }
  const double small_count = kSmallFraction * volume / sphere_volume(kSmallest);
  const int sites = static_cast<int>(std::cbrt(small_count / (1 - kLargeFraction)));
  const double spacing = side / sites;
  std::mt19937_64 engine(kSeed);
  const auto shaken = [&](int site) { return spacing * (site + 0.3 * (2 * uniform(engine) - 1)); };
  for (int x = 0; x < sites; ++x)
    for (int y = 0; y < sites; ++y)
      for (int z = 0; z < sites; ++z) {
        const double px = shaken(x), py = shaken(y), pz = shaken(z);
        if (!packing.is_free({px, py, pz}, kSmallest)) continue;
        scene->positions.push_back({px, py, pz});
        scene->radii.push_back(kSmallest);
      }
  scene->box = packing.box();
  scene->skin = kSkin;
  scene->step_length = kStep;
  scene->origin = "large spheres of volume fraction 0.2 among small ones of 0.15, moved at random";
  scene->start();
  return scene;
}

std::unique_ptr<RandomScene> make_continuous_sizes(double scale, double ratio) {
  constexpr double kFraction = 0.35;
  auto scene = std::make_unique<RandomScene>(kSeed);
  const int count = static_cast<int>(30000 * scale);
  double volume = 0;
  for (int k = 0; k < count; ++k) {
    // The quantiles of a density that falls as the cube of the radius, the largest first.
    const double above = (k + 0.5) / count;
    const double radius = kSmallest / std::sqrt(1 - (1 - above) * (1 - 1 / (ratio * ratio)));
    scene->radii.push_back(radius);
    volume += sphere_volume(radius);
  }
  Packing packing(std::cbrt(volume / kFraction));
  for (const double radius : scene->radii) scene->positions.push_back(packing.place(radius));
  scene->box = packing.box();
  scene->skin = kSkin;
  scene->step_length = kStep;
  scene->origin =
      "spheres of volume fraction 0.35, numbers falling as the cube of the radius, moved at random";
  scene->start();
  return scene;
}

}  // namespace dch::bench
