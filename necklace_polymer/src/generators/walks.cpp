// SPDX-License-Identifier: MIT
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <dch/necklace/contacts.hpp>
#include <dch/necklace/layered_hierarchy.hpp>
#include <dch/necklace/walks.hpp>

#include "chains/parameter_check.hpp"
#include "generators/hilbert_curve.hpp"
#include "generators/random.hpp"

namespace dch::necklace {

using detail::Random;
using detail::require_parameter;

namespace {

void require_beads(std::int32_t beads) {
  require_parameter(beads >= 0, "a walk of " + std::to_string(beads) + " beads; it has to be 0 or more");
}

/// A rotation, as the images of the axes.
struct Rotation {
  Vec3 x, y, z;
  Vec3 operator()(Vec3 p) const { return p.x * x + p.y * y + p.z * z; }
};

Rotation random_rotation(Random& random) {
  const Vec3 x = random.direction();
  Vec3 y;
  double length2 = 0;
  do {  // perpendicular to x; drawn again if it is nearly parallel
    const Vec3 other = random.direction();
    y = other - dot(other, x) * x;
    length2 = norm2(y);
  } while (length2 < 1e-4);
  y = (1 / std::sqrt(length2)) * y;
  return {x, y, cross(x, y)};
}

/// Joins walks of half the length. Walks start at the origin.
class Dimerization {
 public:
  Dimerization(double diameter, std::uint64_t seed) : diameter_(diameter), random_(seed) {}

  std::vector<Vec3> walk(std::int32_t beads) {
    if (beads <= 1) return std::vector<Vec3>(static_cast<std::size_t>(beads));
    const std::vector<Vec3> head = walk(beads - beads / 2);
    for (;;) {
      const std::vector<Vec3> tail = walk(beads / 2);
      for (int attempt = 0; attempt < 100; ++attempt) {
        std::vector<Vec3> joined = head;
        const Vec3 start = head.back() + random_.direction();
        const Rotation rotation = random_rotation(random_);
        for (const Vec3& p : tail) joined.push_back(start + rotation(p));
        if (!halves_meet(joined, head.size())) return joined;
      }
    }
  }

 private:
  bool halves_meet(const std::vector<Vec3>& beads, std::size_t head) const {
    std::vector<std::int32_t> order(beads.size());
    std::iota(order.begin(), order.end(), 0);
    Chains halves(beads.size());
    halves.add({order.data(), head});
    halves.add({order.data() + head, beads.size() - head});
    // The beads at the joint may be exactly one diameter apart.
    LayeredHierarchy hierarchy(Necklace(halves, diameter_ / 2 * (1 - 1e-12)));
    hierarchy.update(beads, Box::none());
    ContactQuery query;
    query.within_chains = false;
    return any_contact(hierarchy, query);
  }

  double diameter_;
  Random random_;
};

}  // namespace

Shape self_avoiding_walk(std::int32_t beads, double diameter, std::uint64_t seed) {
  require_beads(beads);
  require_parameter(diameter >= 0 && diameter <= 1,
                    "the diameter is " + std::to_string(diameter) + "; it has to be in 0 .. 1, the bond");
  return {Dimerization(diameter, seed).walk(beads), false};
}

Shape random_walk(std::int32_t beads, std::uint64_t seed) {
  require_beads(beads);
  Random random(seed);
  Shape shape;
  Vec3 at;
  for (std::int32_t k = 0; k < beads; ++k) {
    shape.positions.push_back(at);
    at = at + random.direction();
  }
  return shape;
}

Shape globule(std::int32_t beads, double jitter, std::uint64_t seed) {
  require_beads(beads);
  require_parameter(beads <= 1 << 30, std::to_string(beads) + " beads are more than 2^30; take fewer");
  require_parameter(jitter >= 0 && jitter <= 0.5,
                    "jitter is " + std::to_string(jitter) + "; it has to be in 0 .. 0.5");
  int bits = 1;
  while (1 << 3 * bits < beads) ++bits;
  Random random(seed);
  Shape shape;
  for (std::int32_t k = 0; k < beads; ++k) {
    const auto cell = detail::hilbert_cell(static_cast<std::uint32_t>(k), bits);
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = cell[static_cast<std::size_t>(axis)] + jitter * (2 * random.uniform() - 1);
    }
    shape.positions.push_back(p);
  }
  return shape;
}

}  // namespace dch::necklace
