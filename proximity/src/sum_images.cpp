// SPDX-License-Identifier: MIT
#include "sum_images.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>

#include "base/describe.hpp"
#include "geometry/near_images.hpp"

namespace dch::detail {
namespace {

constexpr double kMaxImages = 100000;

/// The kernel's sum over lattice vectors longer than `radius` for two points at most `extent` apart, over the
/// kernel at `nearest`. Lattice points are at least `period` apart, so within r of any of them there are
/// at most (1 + 2 r / period)^rank.
double rest_of_lattice(const Box& box, double kappa, double extent, double radius, double nearest) {
  const double period = box.shortest_period();
  double sum = 0, before = 0;
  for (double shell = radius;; shell += period) {
    const double apart = shell - extent, vectors = std::pow(1 + 2 * (shell + period) / period, box.rank());
    const double term = vectors * std::exp(-kappa * (apart - nearest)) * nearest / apart;
    sum += term;
    if (term == 0 || sum >= 1) return sum;  // 1 is too much, and the series may be long
    const double ratio = term / before;     // that of terms to come is smaller
    if (ratio < 1 && term <= 1e-3 * sum) return sum + term * ratio / (1 - ratio);
    before = term;
  }
}

/// An upper bound on the number of lattice vectors up to a length.
double vectors_within(const Box& box, double radius) {
  double number = 1;
  for (int axis = 0; axis < box.rank(); ++axis)
    number *=
        2 * std::floor(radius * std::sqrt(norm2(box.reduced_dual()[static_cast<std::size_t>(axis)]))) + 1;
  return number;
}

}  // namespace

std::vector<Vec3> sum_images(const Box& box, double kappa, double extent, double share) {
  if (!box.any_periodic()) return {Vec3{}};
  if (kappa == 0)
    throw InvalidParameter("kappa is 0 in a periodic box (" + box.description() +
                           "), where sums of 1/r over all images have no limit of their own; take a positive "
                           "kappa, a box without periodic axes, or another method (Ewald's)");
  const double period = box.shortest_period();
  // Each point is within `nearest` of an image of each other one and of one of its own.
  const double nearest = std::max(extent, period);
  double radius = extent + nearest;
  while (rest_of_lattice(box, kappa, extent, radius, nearest) > share) {
    radius += 0.25 * period;
    if (vectors_within(box, radius) > kMaxImages)
      throw InvalidParameter("kappa is " + describe(kappa) + "; in a box with a shortest period of " +
                             describe(period) + " the images of charges beyond " + describe(radius) +
                             " would count, more than " + describe(kMaxImages) +
                             " of them: take a larger kappa, a wider box, or another method (Ewald's)");
  }
  std::vector<Vec3> images{Vec3{}};
  for_each_near_image(box, Vec3{}, radius, false, [&](Vec3 image) {
    if (image != Vec3{}) images.push_back(image);
  });
  return images;
}

}  // namespace dch::detail
