// SPDX-License-Identifier: MIT
#include "engines/ghost_points.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/base/index_count.hpp>

#include "base/describe.hpp"
#include "geometry/position_check.hpp"

namespace dch::detail {
namespace {

/// Two distances round. Images lie as far out as the list radius and the cell more, and reach adds up the
/// components of a vector.
double error_of(const Box& box, double position_reach, double list_radius) {
  return 2 * WrapError(box).bound(position_reach + 2 * list_radius);
}

/// @throws unless there are few enough ghosts
const GhostImages& checked(const GhostImages& ghosts, std::size_t particles, std::int64_t most) {
  if (ghosts.ghosts() > static_cast<double>(most))
    refuse_pairs(ghosts.ghosts(), "images of particles within the cutoff", most);
  constexpr double kCountable = 0x1p62;
  const double all = static_cast<double>(particles) + ghosts.ghosts() + ghosts.images();
  index_count(static_cast<std::int64_t>(std::min(all, kCountable)), "images of particles",
              "take a smaller cutoff");
  return ghosts;
}

}  // namespace

void refuse_pairs(double expected, const char* what, std::int64_t most) {
  throw TooManyPairs("about " + describe(expected) + " " + what + " are expected, and " +
                     std::to_string(most) + " are possible at most; take a smaller cutoff, or more memory");
}

GhostPoints::GhostPoints(Span<const Vec3> given, const Box& box, const HomeImages& home,
                         const NeighborPairsParams& params, double list_radius, double position_reach)
    : given_(given),
      home_(home),
      params_(params),
      error_(error_of(box, position_reach, list_radius)),
      images_(checked({home, box, list_radius + error_}, given.size(), params.max_pairs).cell_images(box)),
      home_image_(images_.number({})),
      positions_(home.positions) {
  for (int axis = 0; axis < 3; ++axis)
    if (box.periodic(axis)) cell_[static_cast<std::size_t>(axis)] = box.vector(axis);
  GhostImages(home, box, list_radius + error_).add(images_, positions_, particle_, image_);
  for (std::size_t point = 0; point < positions_.size(); ++point) {
    const auto i = static_cast<std::size_t>(particle_of(static_cast<std::int32_t>(point)));
    if (!params.radii.empty()) radii_.push_back(params.radii[i]);
    if (!params.types.empty()) types_.push_back(params.types[i]);
  }
}

/// The same whichever comes first: displacements are exactly the opposite then, as all roundings are.
bool GhostPoints::is_pair(std::int32_t a, std::int32_t b) const {
  if (a > b) std::swap(a, b);
  const auto i = static_cast<std::size_t>(particle_of(a)), j = static_cast<std::size_t>(particle_of(b));
  const HomeImages::Shift &image = images_.shifts()[image_of(b)], &from = home_.shifts[i],
                          &to = home_.shifts[j];
  Vec3 d = given_[j] - given_[i];
  for (std::size_t k = 0; k < 3; ++k) d = d + static_cast<double>(image[k] + to[k] - from[k]) * cell_[k];
  const double reach = pair_reach(params_, i, j);
  return norm2(d) <= reach * reach;
}

void GhostPoints::ask(ListParams& request) const {
  request.radii = radii_;
  request.types = types_;
  request.first_ghost = count();
  request.kind = ListKind::full;
}

}  // namespace dch::detail
