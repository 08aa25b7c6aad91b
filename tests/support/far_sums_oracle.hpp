// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <dch/proximity/point_tree.hpp>

namespace dch::test {

/// By summing over all pairs, in all images that count.
struct DirectSum {
  double potential = 0, of_absolute = 0;
  double nearest = std::numeric_limits<double>::infinity();  ///< of those that do not coincide
};

/// Lattice vectors up to a length.
inline std::vector<Vec3> lattice_within(const Box& box, double length) {
  std::vector<Vec3> vectors{Vec3{}};
  for (int axis = 0; axis < box.rank(); ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const int most = static_cast<int>(std::ceil(length * std::sqrt(norm2(box.reduced_dual()[k]))));
    std::vector<Vec3> wider;
    for (const Vec3 v : vectors)
      for (int n = -most; n <= most; ++n) wider.push_back(v + static_cast<double>(n) * box.reduced()[k]);
    vectors = std::move(wider);
  }
  std::erase_if(vectors, [&](Vec3 v) { return norm2(v) > length * length; });
  return vectors;
}

inline DirectSum direct_sum(const PointTree& tree, const std::vector<double>& charges, double kappa,
                            std::int32_t id) {
  const Box& box = tree.box();
  const double reach = box.any_periodic() ? 2 * box.shortest_period() + 40 / kappa : 0;
  const std::vector<Vec3> lattice = lattice_within(box, reach);
  const Vec3 at = box.wrap(tree.position(id));
  DirectSum sum;
  for (const std::int32_t other : tree.ids()) {
    const double charge = charges[static_cast<std::size_t>(other)];
    const Vec3 from = box.nearest_image(box.wrap(tree.position(other)) - at);
    for (const Vec3 image : lattice) {
      const double r = std::sqrt(norm2(from + image));
      if (!(r > tree.rounding())) continue;
      const double kernel = std::exp(-kappa * r) / r;
      sum.potential += charge * kernel;
      sum.of_absolute += std::abs(charge) * kernel;
      sum.nearest = std::min(sum.nearest, r);
    }
  }
  return sum;
}

}  // namespace dch::test
