// SPDX-License-Identifier: MIT
#include "engines/pair_finder.hpp"

#include <algorithm>
#include <memory>

#include <dch/engines/pair_search.hpp>

#include "geometry/position_check.hpp"
#include "lists/list_check.hpp"

namespace dch::detail {
namespace {

/// Where the cutoff is nearer to half a height than this, two images may be in reach by rounding.
constexpr double kOneImage = 1 - 1e-9;
/// A grid alone makes lists of 64 points in half the time that the choice of an engine takes.
constexpr std::size_t kFewPoints = 1000;
/// Rows by which the number of pairs is estimated, and about how many points are looked at for each.
constexpr std::size_t kSampledRows = 8, kSampledPoints = 8192;

/// Decides near the cutoff from positions as given.
class ByDefinition : public TieBreaker {
 public:
  explicit ByDefinition(const GhostPoints& points) : TieBreaker(points.error()), points_(points) {}
  bool accepts(std::int32_t i, std::int32_t j) const override { return points_.is_pair(i, j); }

 private:
  const GhostPoints& points_;
};

ListParams request_of(const NeighborPairsParams& params) {
  ListParams request;
  request.cutoffs = params.cutoffs;
  request.skin = params.skin;
  request.radii = params.radii;
  request.types = params.types;
  request.kind = params.kind;
  request.exclusions = params.exclusions;
  return request;
}

bool is_direct(std::size_t particles, double radius, const Box& box) {
  return particles == 0 || radius <= kOneImage * box.max_cutoff();
}

/// About how many pairs there are of n particles and points, of which the first n are those at home.
template <class ParticleOf>
double expected_number(const NeighborPairsParams& params, std::size_t n, Span<const Vec3> points,
                       const Box& box, const ParticleOf& particle_of) {
  if (n == 0) return 0;
  const std::size_t rows = std::min(n, kSampledRows), stride = 1 + points.size() / kSampledPoints;
  double found = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t i = n * row / rows;
    std::int64_t asked = 0, near = 0;
    for (std::size_t point = 0; point < points.size(); point += stride) {
      if (point == i) continue;
      const double reach = pair_reach(params, i, static_cast<std::size_t>(particle_of(point)));
      near += static_cast<int>(box.distance2(points[i], points[point]) <= reach * reach);
      ++asked;
    }
    if (asked > 0)
      found +=
          static_cast<double>(near) * static_cast<double>(points.size() - 1) / static_cast<double>(asked);
  }
  const double share = params.kind == ListKind::half ? 0.5 : 1;
  return share * found * static_cast<double>(n) / static_cast<double>(rows);
}

}  // namespace

PairFinder::PairFinder(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params)
    : given_(positions), box_(box), params_(params), request_(request_of(params)) {
  check_list_params(request_, positions.size(), request_.list_radius());
  reach_ = check_positions(positions, box);
  radius_ = request_.list_radius();
  home_.emplace(positions, box);
  if (!is_direct(positions.size(), radius_, box))
    ghosts_.emplace(positions, box, *home_, params, radius_, reach_);
  check_expected();
}

bool PairFinder::has_rounded_images() const {
  return !ghosts_ && radius_ + 2 * WrapError(box_).bound(reach_) <= kOneImage * box_.max_cutoff();
}

double PairFinder::expected() const {
  return expected_number(params_, given_.size(), points(), ghosts_ ? Box::none() : box_, [&](std::size_t k) {
    return ghosts_ ? ghosts_->particle_of(static_cast<std::int32_t>(k)) : static_cast<std::int32_t>(k);
  });
}

/// Where there might be too many.
void PairFinder::check_expected() const {
  const auto most = static_cast<double>(params_.max_pairs);
  if (static_cast<double>(given_.size()) * static_cast<double>(points().size()) <= most) return;
  if (const double pairs = expected(); pairs > most) refuse_pairs(pairs, "pairs", params_.max_pairs);
}

NeighborList PairFinder::find(ListKind kind, RowOrder order) const {
  ListParams request = request_;
  request.kind = kind;
  request.order = order;
  std::optional<ByDefinition> by_definition;
  if (ghosts_) {
    by_definition.emplace(*ghosts_);
    request.tie_breaker = &*by_definition;
    request.exclusions = nullptr;  // they do not name ghosts
    ghosts_->ask(request);
  }
  const std::unique_ptr<PairSearch> search = engine(radius_ + request.cutoff_error());
  if (ghosts_)
    search->update(ghosts_->positions(), Box::none());
  else
    search->update_by_reference(given_, box_);
  return search->list(request);
}

/// Few points are listed before the other engine has chosen.
std::unique_ptr<PairSearch> PairFinder::engine(double radius) const {
  if (points().size() <= kFewPoints) return make_grid_search(radius, params_.executor);
  HierarchyParams by;
  by.radius = radius;
  by.executor = params_.executor;
  by.size_classes = !params_.radii.empty() || !params_.types.empty();
  return make_auto_search(by);
}

double expected_pairs_of(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params) {
  const ListParams request = request_of(params);
  check_list_params(request, positions.size(), request.list_radius());
  if (!is_direct(positions.size(), request.list_radius(), box))
    return PairFinder(positions, box, params).expected();
  check_positions(positions, box);
  return expected_number(params, positions.size(), positions, box, [](std::size_t k) { return k; });
}

}  // namespace dch::detail
