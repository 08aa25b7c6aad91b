// SPDX-License-Identifier: MIT
//
// Forces of angles equal slopes of the energy in long double.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/forces/angles.hpp>

#include "instruction_sets.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

using Long = long double;
using LongVec = std::array<Long, 3>;

LongVec difference(const Vec3& a, const Vec3& b) {
  return {Long{a.x} - b.x, Long{a.y} - b.y, Long{a.z} - b.z};
}
Long dot(const LongVec& a, const LongVec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
LongVec cross(const LongVec& a, const LongVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The slope of an energy over the angle, divided by the sine, and the numbers that it is a difference of.
struct Slope {
  Long over_sine, size;
};
using SlopeOf = std::function<Slope(int type, Long angle, Long sine)>;

struct PlainForces {
  std::vector<Vec3> forces;
  /// Of each particle, the sum of these numbers over the shorter bond: what rounding is measured by, since
  /// forces of nearly straight angles are small differences of numbers as large as this.
  std::vector<double> sizes;
  std::array<double, 6> virial{};
};

/// The gradient of an angle stands at right angles to each bond, in the plane of both, with length 1 over the
/// bond's.
PlainForces plain_forces(const std::vector<AngleOfType>& angles, const SlopeOf& slope,
                         const std::vector<Vec3>& positions) {
  PlainForces sums{std::vector<Vec3>(positions.size()), std::vector<double>(positions.size()), {}};
  for (const AngleOfType& angle : angles) {
    const auto i = static_cast<std::size_t>(angle.i), apex = static_cast<std::size_t>(angle.apex),
               k = static_cast<std::size_t>(angle.k);
    const LongVec a = difference(positions[i], positions[apex]),
                  b = difference(positions[k], positions[apex]);
    const LongVec normal = cross(a, b);
    const Long a2 = dot(a, a), b2 = dot(b, b), lengths = std::sqrt(a2 * b2);
    if (lengths == 0) continue;
    const Long sine = std::sqrt(dot(normal, normal)) / lengths;
    const Slope found = slope(angle.type, std::atan2(sine, dot(a, b) / lengths), sine);
    const auto scaled = [](const LongVec& v, Long by) {
      return Vec3{static_cast<double>(by * v[0]), static_cast<double>(by * v[1]),
                  static_cast<double>(by * v[2])};
    };
    const Vec3 on_i = scaled(cross(a, normal), -found.over_sine / (lengths * a2));
    const Vec3 on_k = scaled(cross(normal, b), -found.over_sine / (lengths * b2));
    const double size = static_cast<double>(found.size / std::sqrt(std::min(a2, b2)));
    for (const auto& [at, force] :
         {std::pair{i, on_i}, std::pair{k, on_k}, std::pair{apex, -1.0 * (on_i + on_k)}}) {
      sums.forces[at] = sums.forces[at] + force;
      sums.sizes[at] += size;
    }
    const int rows[] = {0, 1, 2, 0, 0, 1}, columns[] = {0, 1, 2, 1, 2, 2};
    for (std::size_t m = 0; m < 6; ++m) {
      const auto row = static_cast<std::size_t>(rows[m]);
      sums.virial[m] += static_cast<double>(a[row] * on_i[columns[m]] + b[row] * on_k[columns[m]]);
    }
  }
  return sums;
}

/// A chain that folds back, goes straight on, stands still and does anything else.
struct AngleScene {
  std::vector<Vec3> positions{2};
  std::vector<AngleOfType> angles;

  AngleScene(std::size_t count, std::size_t types) {
    scenes::Random random(5);
    positions[1] = {0.9, 0.1, -0.2};
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 last = positions[k + 1] - positions[k];
      Vec3 next = random.in_ball(1.5);
      if (k % 50 == 3) next = {};
      if (k % 50 == 13) next = 0.7 * last;
      if (k % 50 == 23) next = -0.7 * last + 1e-5 * random.in_ball(1);
      if (k % 50 == 33) next = 1.2 * last + 0.02 * random.in_ball(1);
      positions.push_back(positions.back() + next);
      const auto here = static_cast<std::int32_t>(k);
      angles.push_back({here, here + 1, here + 2, 1 + static_cast<std::int32_t>(k % types)});
    }
  }
};

void expect_near(const std::vector<Vec3>& forces, const PlainForces& expected, const std::string& what) {
  for (std::size_t i = 0; i < forces.size(); ++i)
    ASSERT_LE(std::sqrt(norm2(forces[i] - expected.forces[i])), 4e-15 * expected.sizes[i])
        << what << ' ' << i;
}

void expect_forces(const AngleForces& forms, const SlopeOf& slope, const AngleScene& scene,
                   const std::string& scene_name) {
  const RestoreInstructionSet restore;
  const PlainForces expected = plain_forces(scene.angles, slope, scene.positions);
  double scale = 1;
  for (const double size : expected.sizes) scale = std::max(scale, size);
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    const std::string what = scene_name + ", " + name(set);
    std::vector<Vec3> forces(scene.positions.size()), again(scene.positions.size());
    forms.add_forces(scene.angles, 1, scene.positions, forces);
    expect_near(forces, expected, what);
    std::array<double, 6> virial{1, 1, 1, 1, 1, 1};
    forms.add_forces(scene.angles, 1, scene.positions, again, &virial);
    EXPECT_EQ(again, forces) << what;
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(virial[k], expected.virial[k] + 1, 1e-13 * scale) << what << ' ' << k;
  }
}

Slope slope_of(const HarmonicAngle& type, Long angle, Long sine) {
  const Long stiffness = 2 * Long{type.k} / std::max(sine, Long{0.001});
  return {stiffness * (angle - type.theta0), stiffness * (angle + std::abs(type.theta0))};
}

TEST(AnglesTest, EqualAPlainLoop) {
  for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 500u})
    for (const std::size_t type_count : {1u, 3u}) {
      std::vector<HarmonicAngle> harmonic;
      std::vector<CosineAngle> cosine;
      for (std::size_t k = 0; k < type_count; ++k) {
        harmonic.push_back({30.0 + static_cast<double>(k), 1.9 + 0.3 * static_cast<double>(k)});
        cosine.push_back({2.0 + static_cast<double>(k)});
      }
      const AngleScene scene(count, type_count);
      const std::string what = std::to_string(count) + ' ' + std::to_string(type_count);
      expect_forces(
          AngleForces(harmonic),
          [&](int type, Long angle, Long sine) {
            return slope_of(harmonic[static_cast<std::size_t>(type - 1)], angle, sine);
          },
          scene, "harmonic " + what);
      expect_forces(
          AngleForces(cosine),
          [&](int type, Long, Long) {
            const Long k = cosine[static_cast<std::size_t>(type - 1)].k;
            return Slope{-k, k};
          },
          scene, "cosine " + what);
    }
}

/// Small angles and those near pi keep all their digits.
TEST(AnglesTest, NearlyStraightOnes) {
  for (const double bend : {1e-2, 1e-4, 1e-8, 1e-12, 0.0}) {
    AngleScene scene(0, 1);
    scene.positions = {{-1, 0, 0}, {0, 0, 0}, {std::cos(bend), std::sin(bend), 0}};
    scene.angles = {{0, 1, 2, 1}};
    const HarmonicAngle straight{10, 3.14159265358979324 - 0.5};
    expect_forces(
        AngleForces(std::vector<HarmonicAngle>{straight}),
        [&](int, Long angle, Long sine) { return slope_of(straight, angle, sine); }, scene,
        "bend " + std::to_string(bend));
  }
}

TEST(AnglesTest, RefuseWhatDoesNotFit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Harmonic = std::vector<HarmonicAngle>;
  EXPECT_THROW(AngleForces(Harmonic{{nan, 1}}), InvalidParameter);
  EXPECT_THROW(AngleForces(Harmonic{{30, 1}, {30, nan}}), InvalidParameter);
  EXPECT_THROW(AngleForces(std::vector<CosineAngle>{{nan}}), InvalidParameter);
  const std::vector<Vec3> positions(2);
  std::vector<Vec3> forces(1);
  EXPECT_THROW(AngleForces(Harmonic{{30, 1}}).add_forces({}, 1, positions, forces), InvalidParameter);
}

}  // namespace
}  // namespace dch
