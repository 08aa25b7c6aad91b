// SPDX-License-Identifier: MIT
#include "leaf_nearest.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/metric.hpp"
#include "geometry/position_check.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

/// Candidates beyond k that there is room for. More are there where points coincide to within rounding.
constexpr std::int32_t kSpareRoom = 32;
/// How far to look, in units of the radius of a ball that holds as many points as are wanted where density is
/// that of the subtree's ball: points do not fill that ball, and those at its edge look beyond it.
constexpr double kReachFactor = 1.25;
/// A subtree says what the density is if it has so many times the points that are wanted.
constexpr std::int64_t kEnough = 4;

}  // namespace

template <class Metric>
LeafNearest<Metric>::LeafNearest(const Metric& metric, const Structure& structure, const SubtreeBalls& balls,
                                 std::int32_t k)
    : structure_(structure),
      balls_(balls),
      k_(k),
      slack_(WrapError(structure.box).bound(structure.largest_reach)),
      near_(structure, balls),
      descent_(metric, structure, balls),
      metric_(metric),
      kernels_(nearest_kernels(instruction_set())) {
  found_slot_.resize(static_cast<std::size_t>(k) + kSpareRoom);
  found_distance2_.resize(found_slot_.size());
}

/// A distance within which the points of a leaf probably have as many neighbors as are wanted.
template <class Metric>
double LeafNearest<Metric>::guess_reach(std::int32_t leaf) const {
  const std::int64_t wanted = kEnough * (std::int64_t{k_} + 1);
  int level = 1;
  std::int32_t node = leaf;
  while (balls_.count(level, node) < wanted && structure_.parent(level, node) != kNone)
    node = structure_.parent(level++, node);
  const auto share = static_cast<double>(k_ + 1) / static_cast<double>(balls_.count(level, node));
  return kReachFactor * balls_.radius(level, node) * std::cbrt(share);
}

template <class Metric>
void LeafNearest<Metric>::search_leaf(std::int32_t leaf, NearestRows& rows) {
  // Of a view that is kept up the points are not measured.
  const double reach = structure_.measured ? guess_reach(leaf) : 0;
  if (structure_.measured && has_one_image(reach)) {
    near_.collect(metric_, leaf, reach, work_);
    if (has_one_image(std::sqrt(limit2(reach)) + error())) {
      for (std::int32_t block = 0; block < near_.own_blocks(); ++block) search_block(block, reach, rows);
      return;
    }
  }
  structure_.for_each_child(1, leaf,
                            [&](std::int32_t slot) { search_point(structure_.points.id[slot], rows); });
}

/// Whether a point has at most one image within that distance of another one, and none of its own.
template <class Metric>
bool LeafNearest<Metric>::has_one_image(double distance) const {
  return distance * kInflate < structure_.box.max_cutoff();
}

/// How far two distances in float may be off together.
template <class Metric>
double LeafNearest<Metric>::error() const {
  return 2 * (near_.rounding() + slack_);
}

/// What their squares may differ by, beside kBlur: (d + e)^2 <= d^2 (1 + b) + e^2 (1 + 1/b).
template <class Metric>
double LeafNearest<Metric>::blur() const {
  return error() * error() * (1 + 2 / double{kBlur});
}

/// Squared distances in float up to this are looked at.
template <class Metric>
double LeafNearest<Metric>::limit2(double reach) const {
  return reach * reach * (1 + double{kBlur}) + blur();
}

template <class Metric>
void LeafNearest<Metric>::search_block(std::int32_t block, double reach, NearestRows& rows) {
  select(block, reach + near_.rounding());
  for (std::int32_t lane = 0; lane < near_.blocks().count[block]; ++lane) {
    const std::int32_t slot = block * kBlock + lane;
    if (!search_near(slot, reach, rows)) search_point(near_.id(slot), rows);
  }
}

/// The blocks within reach of one of the leaf's own, the nearest first.
template <class Metric>
void LeafNearest<Metric>::select(std::int32_t block, double reach) {
  const NearBlocks blocks = near_.blocks();
  const auto room = static_cast<std::size_t>(near_.count()) + kChunk;
  block_.resize(room);
  gap2_.resize(room);
  BoxAndReach box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = blocks.low[axis][block];
    box.high[axis] = blocks.high[axis][block];
  }
  box.reach2 = static_cast<float>(reach * reach * (1 + double{kBlur}));
  const std::int32_t count = kernels_.select(box, blocks, near_.count(), block_.data(), gap2_.data());
  work_.blocks += near_.count();
  sorted_.clear();
  for (std::int32_t n = 0; n < count; ++n) sorted_.push_back({gap2_[n], block_[n]});
  std::sort(sorted_.begin(), sorted_.end(), [](const Selected& a, const Selected& b) {
    return a.gap2 != b.gap2 ? a.gap2 < b.gap2 : a.block < b.block;
  });
  for (std::size_t n = 0; n < sorted_.size(); ++n) {
    gap2_[n] = sorted_[n].gap2;
    block_[n] = sorted_[n].block;
  }
}

/// Looks among the selected blocks. Returns false if there may be nearer points than those found there.
template <class Metric>
bool LeafNearest<Metric>::search_near(std::int32_t slot, double reach, NearestRows& rows) {
  const float* const at = near_.blocks().coordinates + slot / kBlock * 3 * kBlock + slot % kBlock;
  const NearestTask task{{at[0], at[kBlock], at[2 * kBlock]},
                         slot,
                         block_.data(),
                         gap2_.data(),
                         static_cast<std::int32_t>(sorted_.size()),
                         k_,
                         static_cast<std::int32_t>(found_slot_.size()),
                         static_cast<float>(limit2(reach)),
                         static_cast<float>(blur())};
  NearestFound found{found_distance2_.data(), found_slot_.data(), 0, false, 0, 0};
  kernels_.search(task, near_.blocks(), found);
  work_.blocks += found.blocks_seen;
  work_.points += found.points_seen;
  if (found.is_full || found.count < k_) return false;
  const std::int32_t id = near_.id(slot);
  best_.clear(k_);
  for (std::int32_t n = 0; n < found.count; ++n) {
    const std::int32_t other = near_.id(found.slot[n]);
    best_.add(structure_.box.distance2(structure_.raw[id], structure_.raw[other]), other);
  }
  const double certain = reach - slack_;  // all points within this were there
  if (certain < 0 || best_.limit2() * kInflate > certain * certain) return false;
  best_.write(rows.id.data() + id * static_cast<std::ptrdiff_t>(k_),
              rows.distance2.data() + id * static_cast<std::ptrdiff_t>(k_));
  return true;
}

template <class Metric>
void LeafNearest<Metric>::search_point(std::int32_t id, NearestRows& rows) {
  best_.clear(k_);
  descent_.search(structure_.raw[id], id, 0, best_);
  best_.write(rows.id.data() + id * static_cast<std::ptrdiff_t>(k_),
              rows.distance2.data() + id * static_cast<std::ptrdiff_t>(k_));
}

template <class Metric>
NearestWork LeafNearest<Metric>::work() const {
  return {work_.nodes + descent_.work.nodes, work_.blocks + descent_.work.blocks,
          work_.points + descent_.work.points};
}

template class LeafNearest<OpenMetric>;
template class LeafNearest<OrthorhombicMetric>;
template class LeafNearest<LatticeMetric>;

}  // namespace dch::detail
