// SPDX-License-Identifier: MIT
//
// The inner loops of hard spheres on every instruction set, against formulas for one pair at a time, to the
// last bit: in boxes of every kind, with and without growth.
#include "simd/sphere_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/base/instruction_set.hpp>

#include "images.hpp"
#include "scenes.hpp"

namespace dch::kinetic {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

/// Until |r + v t| = d + g t, for spheres that approach.
double time_to_contact(Vec3 r, Vec3 v, double d, double g) {
  const double half = dot(r, v) - d * g, square = norm2(v) - g * g;
  const double discriminant = norm2(d * v - g * r) - norm2(cross(r, v));
  const double excess = norm2(r) - d * d;
  if (!(discriminant > 0) || (half >= 0 && (g == 0 || square >= 0))) return kNone;
  const double root = std::sqrt(discriminant);
  return half < 0 ? excess / (root - half) : (half + root) / -square;
}

double contact_time(const Images& images, const Flight& p, const Flight& q, const ContactLaw& law) {
  const double start = std::max(p.time, q.time);
  const Vec3 velocity = q.velocity - p.velocity;
  Vec3 apart = (q.position + (start - q.time) * q.velocity) - (p.position + (start - p.time) * p.velocity);
  const Vec3 present = apart + (law.now - start) * velocity;
  const Vec3 nearest = images.box().nearest_image(present);
  if (nearest != present) apart = apart + images.to_image(present, nearest);
  const double sum = p.radius + q.radius;
  const double after =
      time_to_contact(apart, velocity, sum * (law.scale + law.growth * start), sum * law.growth);
  return std::max(law.now, start + after);
}

struct Scene {
  explicit Scene(std::uint64_t seed) : random(seed), boxes(scenes::all_boxes(random.uniform(3, 7))) {
    law = {random.uniform(1, 2), random.uniform(0.5, 1), random.below(2) == 0 ? 0 : random.uniform(0, 1)};
    const Box& box = boxes[seed % boxes.size()].box;
    for (int k = 0; k < 40; ++k) {
      const Vec3 at = box.wrap(random.in_cube(5));
      flights.push_back({at, random.uniform(0, law.now), random.in_cube(2), random.uniform(0.05, 0.3)});
      balls.push_back({at, random.uniform(0.1, 1)});
      if (k > 0) row.push_back(k);
    }
  }
  const Box& box(std::uint64_t seed) const { return boxes[seed % boxes.size()].box; }

  scenes::Random random;
  std::vector<scenes::NamedBox> boxes;
  ContactLaw law{};
  std::vector<Flight> flights;
  std::vector<Ball> balls;
  std::vector<std::int32_t> row;
};

std::vector<InstructionSet> supported_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512})
    if (is_supported(set)) sets.push_back(set);
  return sets;
}

TEST(SphereKernels, GiveTheTimesOfOnePairAfterTheOtherOnEverySet) {
  int contacts = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Scene scene(seed);
    const Images images(scene.box(seed));
    const std::size_t count = seed % scene.row.size();
    for (const InstructionSet set : supported_sets()) {
      SCOPED_TRACE(name(set) + ", seed " + std::to_string(seed) + ", " + images.box().description());
      std::vector<double> times(count + kMostLanes);
      const double least = sphere_kernels(set).contact_times(scene.flights.data(), 0, scene.row.data(), count,
                                                             NearestImages(images), scene.law, times.data());
      double expected_least = kNone;
      for (std::size_t k = 0; k < count; ++k) {
        const double expected = contact_time(images, scene.flights[0], scene.flights[k + 1], scene.law);
        EXPECT_EQ(times[k], expected);
        expected_least = std::min(expected_least, expected);
        contacts += expected < kNone ? 1 : 0;
      }
      EXPECT_EQ(least, expected_least);
    }
  }
  EXPECT_GT(contacts, 100);
}

TEST(SphereKernels, FindTheBallsThatTouchOnEverySet) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Scene scene(seed);
    const Images images(scene.box(seed));
    const std::size_t count = seed % scene.row.size();
    std::vector<std::int32_t> expected;
    for (std::size_t k = 0; k < count; ++k) {
      const double reach = scene.balls[0].radius + scene.balls[k + 1].radius;
      if (images.box().distance2(scene.balls[0].center, scene.balls[k + 1].center) <= reach * reach)
        expected.push_back(scene.row[k]);
    }
    for (const InstructionSet set : supported_sets()) {
      SCOPED_TRACE(name(set) + ", seed " + std::to_string(seed) + ", " + images.box().description());
      std::vector<std::int32_t> found(count + kMostLanes);
      found.resize(sphere_kernels(set).find_touching(scene.balls.data(), 0, scene.row.data(), count,
                                                     NearestImages(images), found.data()));
      EXPECT_EQ(found, expected);
    }
  }
}

}  // namespace
}  // namespace dch::kinetic
