// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/engines/neighbor_pairs.hpp>
#include <dch/engines/pair_search.hpp>

#include "engines/cell_images.hpp"
#include "engines/ghost_points.hpp"
#include "geometry/lattice.hpp"
#include "geometry/position_check.hpp"
#include "lists/list_check.hpp"

namespace dch {
namespace {

using detail::CellImages;
using detail::GhostPoints;
using detail::HomeImages;
using detail::pair_reach;

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

/// Images of the cell around it. In reduced coordinates, wrapped particles within half the smallest height
/// are in the same or the next one.
CellImages next_images(const Box& box) {
  CellImages::Multiples low{}, high{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(box.rank()); ++k) {
    low[k] = -1;
    high[k] = 1;
  }
  return {box, low, high};
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

/// Fills a NeighborPairs.
class NeighborPairsMaker {
 public:
  NeighborPairsMaker(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params)
      : given_(positions), box_(box), params_(params), request_(request_of(params)) {
    detail::check_list_params(request_, positions.size(), request_.list_radius());
    const double reach = detail::check_positions(positions, box);
    radius_ = request_.list_radius();
    home_.emplace(positions, box);
    if (!is_direct(positions.size(), radius_, box))
      ghosts_.emplace(positions, box, *home_, params, radius_, reach);
    check_expected();
  }

  NeighborPairs make() {
    NeighborPairs out;
    out.has_skin_ = params_.skin > 0;
    out.may_change_box_ = !ghosts_;
    out.cutoffs_ = params_.cutoffs;
    out.types_.assign(params_.types.begin(), params_.types.end());
    out.radii_.assign(params_.radii.begin(), params_.radii.end());
    out.box_ = box_;
    for (int axis = 0; axis < 3; ++axis)
      if (box_.periodic(axis)) out.cell_[static_cast<std::size_t>(axis)] = box_.vector(axis);
    if (!given_.empty()) take_pairs(out);
    out.home_ = std::move(home_->shifts);
    if (out.has_skin_) out.home_positions_ = std::move(home_->positions);
    return out;
  }

  double expected() const {
    return expected_number(params_, given_.size(), points(), ghosts_ ? Box::none() : box_,
                           [&](std::size_t k) { return particle_of(static_cast<std::int32_t>(k)); });
  }

 private:
  const std::vector<Vec3>& points() const { return ghosts_ ? ghosts_->positions() : home_->positions; }
  std::int32_t particle_of(std::int32_t point) const { return ghosts_ ? ghosts_->particle_of(point) : point; }

  /// Where there might be too many.
  void check_expected() const {
    const auto most = static_cast<double>(params_.max_pairs);
    if (static_cast<double>(given_.size()) * static_cast<double>(points().size()) <= most) return;
    if (const double pairs = expected(); pairs > most)
      detail::refuse_pairs(pairs, "pairs", params_.max_pairs);
  }

  /// Few points are listed before the other engine has chosen.
  std::unique_ptr<PairSearch> engine(double radius) const {
    if (points().size() <= kFewPoints) return make_grid_search(radius, params_.executor);
    HierarchyParams by;
    by.radius = radius;
    by.executor = params_.executor;
    by.size_classes = !params_.radii.empty() || !params_.types.empty();
    return make_auto_search(by);
  }

  NeighborList find() const {
    ListParams request = request_;
    std::optional<ByDefinition> by_definition;
    if (ghosts_) {
      by_definition.emplace(*ghosts_);
      request.tie_breaker = &*by_definition;
      request.exclusions = nullptr;  // is_wanted() knows of which particle a point is
      ghosts_->ask(request);
    }
    if (request.kind == ListKind::full) request.order = RowOrder::unsorted;
    const std::unique_ptr<PairSearch> search = engine(radius_ + request.cutoff_error());
    if (ghosts_)
      search->update(ghosts_->positions(), Box::none());
    else
      search->update(given_, box_);
    return search->list(request);
  }

  void take_pairs(NeighborPairs& out) const {
    const NeighborList list = find();
    if (ghosts_) {
      out.images_ = ghosts_->images().shifts();
      count_rows(list, out);
      fill_rows(list, out, [&](std::int32_t, std::int32_t j) { return ghosts_->image_of(j); });
    } else {
      const CellImages images = next_images(box_);
      out.images_ = images.shifts();
      count_rows(list, out);
      const std::size_t home = images.number({});
      fill_rows(list, out, [&](std::int32_t i, std::int32_t j) { return nearest_image(images, home, i, j); });
    }
  }

  std::size_t nearest_image(const CellImages& images, std::size_t home_image, std::int32_t i,
                            std::int32_t j) const {
    const Vec3 d =
        home_->positions[static_cast<std::size_t>(j)] - home_->positions[static_cast<std::size_t>(i)];
    const Vec3 nearest = box_.nearest_image(d);
    if (nearest == d) return home_image;
    CellImages::Multiples n{};
    for (std::size_t k = 0; k < 3; ++k)
      n[k] = static_cast<std::int64_t>(std::nearbyint(dot(box_.reduced_dual()[k], nearest - d)));
    return images.number(n);
  }

  /// The particle of a row; of a ghost, whose row is empty, any number from that of the particles on.
  static std::int32_t row_of(const NeighborList& list, std::size_t k) {
    return list.particle.empty() ? static_cast<std::int32_t>(k) : list.particle[k];
  }
  bool is_at_home(std::int32_t i) const { return static_cast<std::size_t>(i) < given_.size(); }

  /// Half lists are made of full ones where there are ghosts, which exclusions do not name.
  bool is_wanted(std::int32_t i, std::int32_t point, const std::vector<NeighborPairs::Shift>& images) const {
    if (!ghosts_) return true;
    const std::int32_t j = ghosts_->particle_of(point);
    if (params_.exclusions != nullptr && params_.exclusions->excluded(i, j)) return false;
    if (params_.kind == ListKind::full) return true;
    return i != j ? i < j : images[ghosts_->image_of(point)] > NeighborPairs::Shift{};
  }

  void count_rows(const NeighborList& list, NeighborPairs& out) const {
    out.first_.assign(given_.size() + 1, 0);
    for (std::size_t k = 0; k < list.size(); ++k) {
      const std::int32_t i = row_of(list, k);
      if (!is_at_home(i)) continue;
      std::int64_t& count = out.first_[static_cast<std::size_t>(i) + 1];
      for (const std::int32_t point : list.row(k))
        count += static_cast<int>(is_wanted(i, point, out.images_));
    }
    for (std::size_t i = 0; i < given_.size(); ++i) out.first_[i + 1] += out.first_[i];
    if (out.listed() > params_.max_pairs)
      detail::refuse_pairs(static_cast<double>(out.listed()), "pairs", params_.max_pairs);
    out.j_.resize(static_cast<std::size_t>(out.listed()));
    out.image_.resize(static_cast<std::size_t>(out.listed()));
  }

  template <class ImageOf>
  void fill_rows(const NeighborList& list, NeighborPairs& out, const ImageOf& image_of) const {
    for_ranges(params_.executor, list.size(), [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) {
        const std::int32_t i = row_of(list, k);
        if (!is_at_home(i)) continue;
        auto at = static_cast<std::size_t>(out.first_[static_cast<std::size_t>(i)]);
        for (const std::int32_t point : list.row(k)) {
          if (!is_wanted(i, point, out.images_)) continue;
          out.j_[at] = particle_of(point);
          out.image_[at++] = static_cast<std::uint32_t>(image_of(i, point));
        }
      }
    });
  }

  Span<const Vec3> given_;
  const Box& box_;
  const NeighborPairsParams& params_;
  ListParams request_;
  double radius_ = 0;
  std::optional<HomeImages> home_;
  std::optional<GhostPoints> ghosts_;  ///< where several images of a particle may be in reach
};

void NeighborPairs::follow(Span<const Vec3> positions, const Box& box) {
  if (positions.size() != home_.size())
    throw InvalidParameter(std::to_string(positions.size()) + " positions given for pairs of " +
                           std::to_string(home_.size()) + " particles; find pairs anew");
  if (!same_periodicity(box, box_))
    throw InvalidParameter(
        "the box is periodic along other vectors than when pairs were found; find them anew");
  detail::check_positions(positions, box);
  if (!has_skin_) return;
  const detail::Lattice lattice(box);
  std::vector<Shift> home(home_.size());
  for (std::size_t i = 0; i < home.size(); ++i) {
    const Vec3 d = positions[i] - home_positions_[i], nearest = box.nearest_image(d);
    if (nearest != d) home[i] = detail::shift_of(lattice.integers(nearest - d));
  }
  home_ = std::move(home);
  for (int axis = 0; axis < 3; ++axis)
    if (box.periodic(axis)) cell_[static_cast<std::size_t>(axis)] = box.vector(axis);
}

void neighbor_pairs(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params,
                    NeighborPairs& out) {
  out = NeighborPairsMaker(positions, box, params).make();
}

NeighborPairs neighbor_pairs(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params) {
  NeighborPairs out;
  neighbor_pairs(positions, box, params, out);
  return out;
}

double expected_pairs(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params) {
  const ListParams request = request_of(params);
  detail::check_list_params(request, positions.size(), request.list_radius());
  if (!is_direct(positions.size(), request.list_radius(), box))
    return NeighborPairsMaker(positions, box, params).expected();
  detail::check_positions(positions, box);
  return expected_number(params, positions.size(), positions, box, [](std::size_t k) { return k; });
}

NeighborPairs neighbor_pairs(Span<const Vec3> positions, const Box& box, double cutoff) {
  NeighborPairsParams params;
  params.cutoffs = TypeCutoffs(cutoff);
  return neighbor_pairs(positions, box, params);
}

}  // namespace dch
