// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <dch/necklace/melt.hpp>

#include "generators/random.hpp"

namespace dch::necklace {

namespace {

using detail::Random;

/// Cube root by Newton's method from above, which decreases until rounding stops it. std::cbrt may differ in
/// the last bit between platforms.
double cube_root(double value) {
  double root = value > 1 ? value : 1;
  for (;;) {
    const double next = (2 * root + value / (root * root)) / 3;
    if (!(next < root)) return root;  // so that infinity ends too
    root = next;
  }
}

void require(bool holds, const std::string& message) {
  if (!holds) throw InvalidParameter(message);
}

void check(const MeltParams& p) {
  require(p.chains >= 1, "chains is " + std::to_string(p.chains) + "; it has to be 1 or more");
  require(p.beads_per_chain >= 1,
          "beads_per_chain is " + std::to_string(p.beads_per_chain) + "; it has to be 1 or more");
  require(std::int64_t{p.chains} * p.beads_per_chain <= std::numeric_limits<std::int32_t>::max(),
          std::to_string(p.chains) + " chains of " + std::to_string(p.beads_per_chain) +
              " beads are more than 2^31 - 1 beads; take fewer");
  require(std::isfinite(p.density) && p.density > 0,
          "density is " + std::to_string(p.density) + "; it has to be finite and > 0");
  require(std::isfinite(p.bond) && p.bond > 0,
          "bond is " + std::to_string(p.bond) + "; it has to be finite and > 0");
  // Beyond 1.9 bonds nearly every direction would be rejected.
  require(p.min_distance_13 >= 0 && p.min_distance_13 <= 1.9 * p.bond,
          "min_distance_13 is " + std::to_string(p.min_distance_13) + "; it has to be in 0 .. 1.9 bond, " +
              std::to_string(1.9 * p.bond));
}

double box_side(const MeltParams& p) {
  const double side =
      cube_root(static_cast<double>(p.chains) * static_cast<double>(p.beads_per_chain) / p.density);
  require(std::isfinite(side) && side >= 4 * p.bond,
          "the box would be " + std::to_string(side) + " wide, which is less than four bonds of " +
              std::to_string(p.bond) + "; take more beads or a lower density");
  return side;
}

/// Puts x into [0, side) and counts the cells it was moved by.
std::int32_t wrap(double& x, double side) {
  auto cells = static_cast<std::int32_t>(std::floor(x / side));
  double inside = x - cells * side;
  // The quotient may have been rounded across a face.
  if (inside < 0) {
    inside += side;
    --cells;
  }
  if (inside >= side) {
    inside -= side;
    ++cells;
  }
  x = inside;
  return cells;
}

/// A bond vector that keeps the bead at least min_distance_13 away from the one before the previous.
Vec3 next_bond(Random& random, const MeltParams& params, Vec3 previous_bond, bool has_previous) {
  for (;;) {
    const Vec3 bond = params.bond * random.direction();
    if (!has_previous) return bond;
    if (norm2(previous_bond + bond) >= params.min_distance_13 * params.min_distance_13) return bond;
  }
}

}  // namespace

Melt make_melt(const MeltParams& params) {
  check(params);
  const double side = box_side(params);
  const auto beads =
      static_cast<std::size_t>(params.chains) * static_cast<std::size_t>(params.beads_per_chain);
  Random random(params.seed);
  Melt melt;
  melt.box = Box::orthorhombic({side, side, side});
  melt.positions.reserve(beads);
  melt.images.reserve(beads);
  melt.molecules.reserve(beads);
  melt.bonds.reserve(beads);
  for (std::int32_t chain = 1; chain <= params.chains; ++chain) {
    Vec3 position, bond;
    for (int axis = 0; axis < 3; ++axis) position[axis] = side * random.uniform();
    std::array<std::int32_t, 3> image{0, 0, 0};
    for (std::int32_t k = 0; k < params.beads_per_chain; ++k) {
      if (k > 0) {
        bond = next_bond(random, params, bond, k > 1);
        position = position + bond;
        const auto index = static_cast<std::int32_t>(melt.positions.size());
        melt.bonds.push_back({index - 1, index});
      }
      for (int axis = 0; axis < 3; ++axis)
        image[static_cast<std::size_t>(axis)] += wrap(position[axis], side);
      melt.positions.push_back(position);
      melt.images.push_back(image);
      melt.molecules.push_back(chain);
    }
  }
  return melt;
}

}  // namespace dch::necklace
