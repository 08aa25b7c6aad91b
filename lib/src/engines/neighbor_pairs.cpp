// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/engines/neighbor_pairs.hpp>

#include "engines/pair_finder.hpp"
#include "geometry/lattice.hpp"
#include "geometry/position_check.hpp"

namespace dch {
namespace {

using detail::CellImages;
using detail::GhostPoints;
using detail::PairFinder;

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

}  // namespace

/// Fills a NeighborPairs.
class NeighborPairsMaker {
 public:
  explicit NeighborPairsMaker(PairFinder& finder)
      : finder_(finder),
        given_(finder.given()),
        box_(finder.box()),
        params_(finder.params()),
        ghosts_(finder.ghosts()) {}

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
    detail::HomeImages home = finder_.take_home();
    out.home_ = std::move(home.shifts);
    if (out.has_skin_) out.home_positions_ = std::move(home.positions);
    return out;
  }

 private:
  void take_pairs(NeighborPairs& out) const {
    const bool is_full = ghosts_ != nullptr || params_.kind == ListKind::full;
    const NeighborList list = finder_.find(is_full ? ListKind::full : ListKind::half,
                                           is_full ? RowOrder::unsorted : RowOrder::by_index);
    if (ghosts_ != nullptr) {
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
    const std::vector<Vec3>& home = finder_.home().positions;
    const Vec3 d = home[static_cast<std::size_t>(j)] - home[static_cast<std::size_t>(i)];
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
    if (ghosts_ == nullptr) return true;
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
          out.j_[at] = ghosts_ != nullptr ? ghosts_->particle_of(point) : point;
          out.image_[at++] = static_cast<std::uint32_t>(image_of(i, point));
        }
      }
    });
  }

  PairFinder& finder_;
  Span<const Vec3> given_;
  const Box& box_;
  const NeighborPairsParams& params_;
  const GhostPoints* ghosts_;
};

NeighborPairs detail::pairs_of(PairFinder& finder) { return NeighborPairsMaker(finder).make(); }

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
  PairFinder finder(positions, box, params);
  out = detail::pairs_of(finder);
}

NeighborPairs neighbor_pairs(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params) {
  NeighborPairs out;
  neighbor_pairs(positions, box, params, out);
  return out;
}

double expected_pairs(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params) {
  return detail::expected_pairs_of(positions, box, params);
}

NeighborPairs neighbor_pairs(Span<const Vec3> positions, const Box& box, double cutoff) {
  NeighborPairsParams params;
  params.cutoffs = TypeCutoffs(cutoff);
  return neighbor_pairs(positions, box, params);
}

}  // namespace dch
