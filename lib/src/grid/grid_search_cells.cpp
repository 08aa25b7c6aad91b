// SPDX-License-Identifier: MIT
//
// How the grid's engine takes positions and puts them into cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include <dch/base/index_count.hpp>

#include "grid/cell_width.hpp"
#include "grid/grid_search.hpp"
#include "grid/stencil.hpp"
#include "leaves/rounding.hpp"

namespace dch::detail {
namespace {

/// List radius of a class with itself or, if it has no pairs with itself, the largest with another one.
double own_reach(const SizeClasses& classes, std::size_t g) {
  double reach = classes.reach_of(g, g);
  for (std::size_t b = 0; b < classes.count && classes.reach_of(g, g) == 0; ++b)
    reach = std::max(reach, classes.reach_of(g, b));
  return reach;
}

constexpr std::size_t kPiece = 512;  ///< positions that are looked at together, while they are in a cache
/// Cells for one reach are as good for another one within this share of it: rounding errors, which are part
/// of it, change with the positions.
constexpr double kLike = 1e-6;

}  // namespace

void GridSearch::take(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys, Keep keep) {
  if (!keys.empty()) key_table_.fill(positions.size(), keys);  // throws if they repeat
  check_radius(radius_, box);
  index_count(static_cast<std::int64_t>(positions.size()), "particles", "divide the system");
  box_ = box;
  has_plain_ = false;
  for (Group& group : groups_) group.reach = group.started = 0;
  copy_.resize(keep == Keep::copy ? positions.size() : 0);
  positions_ = keep == Keep::copy ? Span<const Vec3>(copy_) : positions;
  const PositionCheck check(box_);
  wrap_error_ = check.error().bound(take_and_check(positions, check));
}

/// In one pass. Returns a bound on WrapError::reach of the positions [length].
double GridSearch::take_and_check(Span<const Vec3> positions, const PositionCheck& check) {
  // Cells for lists as the last ones, of a point that is in order at least.
  Group* const group = groups_.size() == 1 && groups_[0].last.reach > 0 ? groups_.data() : nullptr;
  std::optional<CellBins> bins;
  if (group != nullptr) fine_ = group->last.fine;
  if (group != nullptr && !positions.empty() && check.reach_by_box({positions.data(), 1}))
    bins = start_cells(*group, positions, group->last.reach, group->last.own);
  std::mutex mutex;
  bool all_checked = true;
  double largest = 0;
  for_ranges(executor_, positions.size(), [&](std::size_t begin, std::size_t end) {
    double reach = 0;
    bool checked = true;
    for (std::size_t at = begin; at < end; at += kPiece) {
      const Span<const Vec3> piece(positions.data() + at, std::min(kPiece, end - at));
      const std::optional<double> of_piece = check.reach_by_box(piece);
      if (!copy_.empty()) std::copy(piece.begin(), piece.end(), copy_.data() + at);
      checked = checked && of_piece;
      if (!checked) continue;  // positions that are refused are in no cell
      reach = std::max(reach, *of_piece);
      if (bins) group->layer.take(*bins, piece, at);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    largest = std::max(largest, reach);
    all_checked = all_checked && checked;
  });
  if (!all_checked) return check.reach_of_each(positions);
  if (bins) group->started = group->last.reach;
  return largest;
}

/// Begins the cells for pairs within a reach. Returns how points are put into them; none if there are too
/// many cells.
/// @param own reach of the group's points and each other; 0 if they have no pairs [length]
std::optional<CellBins> GridSearch::start_cells(Group& group, Span<const Vec3> positions, double reach,
                                                double own) {
  const std::size_t n = groups_.size() > 1 ? group.particle.size() : positions.size();
  const auto nearby = [&](double width) {
    return group.last.reach > 0 ? std::min(static_cast<double>(n), group.last.density * width * width * width)
                                : points_nearby(positions, members_of(group), box_, width);
  };
  const double narrowest = groups_.size() > 1 ? narrowest_cells(radius_, nearby(2 * radius_)) : 0;
  const CellLayout layout = cells_for(positions, box_, reach, nearby(reach), group.last.spread,
                                      groups_.size() > 1 ? CellUse::with_finer
                                      : fine_            ? CellUse::alone_with_shell
                                                         : CellUse::alone,
                                      narrowest);
  // As GridRows rounds the first layer; others are rounded for each layer that they meet.
  CellRounding rounding;
  if (&group == groups_.data() && !positions.empty())
    rounding = {box_.wrap(positions[0]), finest_unit(widest_in(layout, half_stencil(layout, own)))};
  if (!group.layer.start(n, box_, layout, rounding)) return std::nullopt;
  return CellBins(box_, layout, rounding);
}

/// Returns false if there are too many cells.
bool GridSearch::take_points(Group& group, double reach, double own) {
  const std::optional<CellBins> bins = start_cells(group, positions_, reach, own);
  if (!bins) return false;
  if (groups_.size() == 1) {
    for_ranges(executor_, positions_.size(), [&](std::size_t begin, std::size_t end) {
      group.layer.take(*bins, {positions_.data() + begin, end - begin}, begin);
    });
    return true;
  }
  for_ranges(executor_, group.particle.size(), [&](std::size_t begin, std::size_t end) {
    std::array<Vec3, kPiece> piece;
    for (std::size_t at = begin; at < end; at += kPiece) {
      const std::size_t count = std::min(kPiece, end - at);
      for (std::size_t k = 0; k < count; ++k)
        piece[k] = positions_[static_cast<std::size_t>(group.particle[at + k])];
      group.layer.take(*bins, {piece.data(), count}, at);
    }
  });
  return true;
}

/// Puts the points of each class into cells. Returns false if they lie too far apart for that.
bool GridSearch::sort_points(double error) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    const double own = own_reach(classes_, g), reach = own > 0 ? own : radius_ + error;
    const bool is_fine_enough = group.last.fine || !fine_;
    if (group.reach == reach && is_fine_enough) continue;
    group.reach = 0;
    const bool has_started =
        group.started > 0 && std::abs(reach - group.started) <= kLike * reach && is_fine_enough;
    group.started = 0;
    const bool made_fine = has_started ? group.last.fine : fine_;
    if (!has_started && !take_points(group, reach, own)) return false;
    if (!group.layer.sort(members_of(group))) return false;
    group.reach = reach;
    ++stats_.builds;
    group.last = {};
    if (group.layer.size() == 0) continue;
    const Occupancy& occupancy = group.layer.occupancy();
    group.last = {reach, own, occupancy.of_point / group.layer.layout().cell_volume(), occupancy.spread(),
                  made_fine};
  }
  return true;
}

}  // namespace dch::detail
