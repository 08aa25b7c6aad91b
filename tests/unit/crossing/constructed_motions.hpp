// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/lists/exclusions.hpp>

#include "random.hpp"

/// Motions of two or three bonds that are made to be degenerate, or nearly so. Coordinates are short binary
/// fractions.
namespace dch::crossings {

using scenes::Random;

inline constexpr int kAnyNumber = -1;

struct Motion {
  std::vector<std::vector<Vec3>> frames;  ///< by time, beads
  std::vector<IndexPair> bonds;
  int crossings = kAnyNumber;  ///< in all frames, where that is plain from how the motion is made
  bool is_touch = false;       ///< whether bonds meet without a crossing
};

/// A multiple of 1/8 in [-largest, largest].
inline double eighths(Random& random, double largest) {
  const auto steps = static_cast<std::size_t>(16 * largest) + 1;
  return static_cast<double>(random.below(steps)) / 8 - largest;
}
inline double not_zero(Random& random, double largest) {
  for (;;) {
    const double x = eighths(random, largest);
    if (x != 0) return x;
  }
}
inline Vec3 on_grid(Random& random, double largest) {
  const double x = eighths(random, largest), y = eighths(random, largest);
  return {x, y, eighths(random, largest)};
}

inline const std::vector<IndexPair> kTwoBonds{{0, 1}, {2, 3}};
inline constexpr Vec3 kLeft{-1, 0, 0}, kRight{1, 0, 0};

/// The second bond turns through the first one's line and back at one time: det = c (t - 1/2)^2. `apart`
/// moves it, so that there are two roots or none.
inline Motion double_root(Random& random, double apart) {
  const double x = eighths(random, 0.75);
  Vec3 u, a, b;
  do {
    u = {0, eighths(random, 0.75), eighths(random, 0.75)};
    a = {0, eighths(random, 0.5), eighths(random, 0.5)};
    const double s = not_zero(random, 1);
    b = s * u - a;  // so that the first derivative is 0
  } while (a.y * u.z == a.z * u.y);
  const Vec3 at{x, 0, 0}, by{0, apart, apart};
  Motion motion{{{kLeft, kRight, at - u - 0.5 * a + by, at + u - 0.5 * b + by},
                 {kLeft, kRight, at - u + 0.5 * a + by, at + u + 0.5 * b + by}},
                kTwoBonds};
  motion.is_touch = apart == 0;
  if (apart == 0) motion.crossings = 0;
  return motion;
}

/// det = c (t - 1/2)^3, where the middles of both bonds meet: one crossing.
inline Motion triple_root(Random& random) {
  for (;;) {
    const auto half = [&] { return 0.5 * static_cast<double>(random.below(5)) - 1; };
    // Derivatives of the first bond, the second and of what is between their first beads.
    const Vec3 a{half(), half(), 1}, b{half(), half(), half()};
    Vec3 c{0, half(), 0.5 * (a.z - b.z)};  // the first derivative of det is 0, and with c.x the second
    c.x = 0.5 * (a.y * b.z - a.z * b.y) - 0.5 * (a.z * b.x - a.x * b.z) + a.x * c.z + b.y * c.z - b.z * c.y;
    if (dot(cross(a, b), c) == 0) continue;
    const auto at = [&](double t) {
      return std::vector<Vec3>{
          {-0.5, 0, 0}, Vec3{0.5, 0, 0} + t * a, Vec3{0, -0.5, 0} + t * c, Vec3{0, 0.5, 0} + t * (b + c)};
    };
    return {{at(-0.5), at(0.5)}, kTwoBonds, 1};
  }
}

/// All beads stay in a plane.
inline Motion coplanar(Random& random) {
  const auto flat = [&] {
    const double x = eighths(random, 1);
    return Vec3{x, eighths(random, 1), 0};
  };
  Motion motion{{{}, {}}, kTwoBonds};
  for (auto& frame : motion.frames) {
    for (int k = 0; k < 4; ++k) frame.push_back(flat());
  }
  return motion;
}

/// Parallel or antiparallel at all times: through each other face to face, or along each other.
inline Motion parallel(Random& random) {
  const double from = random.below(3) == 0 ? 0 : 0.5, shift = eighths(random, 1), later = eighths(random, 1);
  const double turn = random.below(2) == 0 ? 1 : -1, longer = 1 + 0.5 * static_cast<double>(random.below(2));
  return {{{kLeft, kRight, {shift - turn, 0, from}, {shift + turn, 0, from}},
           {kLeft, kRight, {later - longer * turn, 0, -from}, {later + longer * turn, 0, -from}}},
          kTwoBonds};
}

/// The end of the second bond slides over the inside of the first one, or goes by at a distance of `apart`.
inline Motion grazing(Random& random, double apart) {
  const double x = eighths(random, 0.75), y = not_zero(random, 0.75);
  return {{{kLeft, kRight, {x, -y, apart}, Vec3{x, -y, 1 + apart} + on_grid(random, 0.25)},
           {kLeft, kRight, {x, y, apart}, Vec3{x, y, 1 + apart} + on_grid(random, 0.25)}},
          kTwoBonds};
}

/// The inside of a bond goes through the common bead of two others, which make an angle of 90 degrees or
/// more.
inline Motion common_bead(Random& random) {
  const Vec3 ahead{1, eighths(random, 0.75), 0};
  const double y = eighths(random, 0.25);
  return {{{kLeft, {0, 0, 0}, ahead, {0, -1 + y, 0.5}, {0, 1 + y, 0.5}},
           {kLeft, {0, 0, 0}, ahead, {0, -1 + y, -0.5}, {0, 1 + y, -0.5}}},
          {{0, 1}, {1, 2}, {3, 4}},
          1};
}

/// The ends of both bonds meet.
inline Motion end_over_end(Random& random) {
  const Vec3 away{not_zero(random, 0.5), eighths(random, 0.5), eighths(random, 0.5)};
  const Vec3 u = on_grid(random, 0.5) + Vec3{0, 0.75, 0.75}, turn = on_grid(random, 0.25);
  return {{{kLeft, kRight, kRight + away, kRight + away + u},
           {kLeft, kRight, kRight - away, kRight - away + u + turn}},
          kTwoBonds};
}

/// Two steps, at whose common time the bonds meet in their insides.
inline Motion common_time(Random& random) {
  const double x = eighths(random, 0.75), height = not_zero(random, 0.75);
  const auto at = [&](double z) { return std::vector<Vec3>{kLeft, kRight, {x, -0.75, z}, {x, 0.75, z}}; };
  const bool goes_back = random.below(3) == 0;
  Motion motion{{at(height), at(0), at(goes_back ? height : -height)}, kTwoBonds};
  if (!goes_back) motion.crossings = 1;
  return motion;
}

inline const std::vector<std::pair<std::string, Motion (*)(Random&)>> kKinds{
    {"double root", [](Random& random) { return double_root(random, 0); }},
    {"nearly a double root",
     [](Random& random) { return double_root(random, random.below(2) == 0 ? 0x1p-30 : -0x1p-30); }},
    {"triple root", triple_root},
    {"coplanar", coplanar},
    {"parallel", parallel},
    {"grazing", [](Random& random) { return grazing(random, 0); }},
    {"nearly grazing",
     [](Random& random) { return grazing(random, random.below(2) == 0 ? 0x1p-30 : -0x1p-30); }},
    {"common bead", common_bead},
    {"end over end", end_over_end},
    {"common time of two steps", common_time},
};

}  // namespace dch::crossings
