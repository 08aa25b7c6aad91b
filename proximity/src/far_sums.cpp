// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>
#include <dch/proximity/far_sums.hpp>

#include "base/describe.hpp"
#include "charged_tree.hpp"
#include "expansions.hpp"
#include "far_descent.hpp"
#include "potential_sums.hpp"
#include "sum_calibration.hpp"
#include "sum_images.hpp"
#include "truncation.hpp"

namespace dch {
namespace {

constexpr double kMinTolerance = 1e-12;

void check(const PointTree& tree, Span<const double> charges, const FarSumParams& params) {
  if (charges.size() != tree.capacity())
    throw InvalidParameter(std::to_string(charges.size()) + " charges for " +
                           std::to_string(tree.capacity()) +
                           " ids; there must be one for each id below PointTree::capacity()");
  for (const std::int32_t id : tree.ids()) {
    const double charge = charges[static_cast<std::size_t>(id)];
    if (!(std::abs(charge) <= kMaxCoordinate))
      throw InvalidParameter("the charge of " + std::to_string(id) + " is " + detail::describe(charge) +
                             "; its magnitude must be at most 1e100");
  }
  if (!(params.tolerance >= kMinTolerance && params.tolerance < 1))
    throw InvalidParameter("the tolerance of far sums is " + detail::describe(params.tolerance) +
                           "; it must be at least 1e-12, which rounding leaves, and below 1");
  if (!(params.kappa >= 0 && std::isfinite(params.kappa)))
    throw InvalidParameter("kappa is " + detail::describe(params.kappa) +
                           "; an inverse screening length must be positive and finite, or 0 for 1/r");
}

/// The order at which sums of that tolerance take least time, as measured.
int order_for(double tolerance, bool is_harmonic) {
  const double digits = -std::log10(tolerance);
  return std::clamp(static_cast<int>(std::lround(is_harmonic ? 1 + 1.5 * digits : 1 + 2 * digits)), 2,
                    detail::kMaxOrder);
}

}  // namespace

FarSums far_sums(const PointTree& tree, Span<const double> charges, const FarSumParams& params) {
  check(tree, charges, params);
  FarSums result;
  result.potentials.assign(tree.capacity(), 0.0);
  result.order = order_for(params.tolerance, params.kappa == 0);
  if (tree.size() == 0) return result;
  const detail::Truncation unscaled(result.order, params.kappa);
  const detail::ChargedTree charged(tree, charges, unscaled.degree());
  const double extent = 2 * charged.node(0).radius * charged.unit();
  const double of_images = tree.box().any_periodic() ? 0.01 * params.tolerance : 0;
  std::vector<Vec3> images = detail::sum_images(tree.box(), params.kappa, extent, of_images);
  for (Vec3& image : images) image = (1 / charged.unit()) * image;
  result.images = static_cast<int>(images.size());
  const detail::Expansions expansions(result.order, params.kappa == 0);
  const detail::Truncation truncation(result.order, params.kappa * charged.unit());
  const double most = params.tolerance - of_images;
  const std::vector<double> least = detail::least_potentials(charged, images, truncation);
  detail::SumScene scene{charged, images, truncation, least, most, most};
  scene.share = detail::share_for(scene);
  detail::PotentialSums sums(charged, expansions);
  // The share was found by some of the targets, so that now and then it is too large for others.
  double error = sums.add_up(scene, params.executor);
  while (error > most) {
    scene.share *= 0.5;
    error = sums.add_up(scene, params.executor);
  }
  result.error_bound = error + of_images;
  result.far_pairs = sums.counts().far_pairs;
  result.near_pairs = sums.counts().near_pairs;
  result.looked_at = sums.counts().looked_at;
  for (std::int32_t place = 0; place < static_cast<std::int32_t>(tree.size()); ++place)
    result.potentials[static_cast<std::size_t>(charged.id(place))] =
        sums.potentials()[static_cast<std::size_t>(place)] / charged.unit();
  return result;
}

}  // namespace dch
