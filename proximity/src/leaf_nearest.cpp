// SPDX-License-Identifier: MIT
#include "leaf_nearest.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>

#include "geometry/metric.hpp"
#include "geometry/position_check.hpp"
#include "geometry/tolerance.hpp"
#include "rank_found.hpp"

namespace dch::detail {
namespace {

/// Squared distances in float that may be equal differ by less than this share of the larger one, plus
/// blur().
constexpr float kBlur = 1e-3f;
/// What is found beyond twice as many as wanted, before the farthest are given up.
constexpr std::int32_t kSpareRoom = 64;
/// Points of selected blocks that are looked at before those that are too far by then are left out.
constexpr std::int32_t kAtOnce = 32 * kChunk;
/// By how much squared distances in that order may descend.
constexpr float kDisorder = 0x1p-15f;
/// Squared distances in float up to this share of what is known to be within reach are as exact as they
/// should be: none is too large for float, and what is lost where they are very small is far below the blur.
constexpr double kLeast2 = 1e-30, kMost2 = 1e36;
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
  const std::size_t room = 2 * static_cast<std::size_t>(k) + kSpareRoom;
  for (Buffer& buffer : buffers_) {
    buffer.distance2.resize(room + kChunk);
    buffer.slot.resize(room + kChunk);
  }
  found_ = {buffers_[0].distance2.data(), buffers_[0].slot.data(), 0, static_cast<std::int32_t>(room)};
  sorted_ = {buffers_[1].distance2.data(), buffers_[1].slot.data(), 0, static_cast<std::int32_t>(room)};
}

/// A distance within which the points of a leaf probably have as many neighbors as are wanted: of points at
/// random with the density of the subtree's ball, twice the standard deviation more are expected there, and
/// one.
template <class Metric>
double LeafNearest<Metric>::guess_reach(std::int32_t leaf) const {
  const std::int64_t wanted = kEnough * (std::int64_t{k_} + 1);
  int level = 1;
  std::int32_t node = leaf;
  while (balls_.count(level, node) < wanted && structure_.parent(level, node) != kNone)
    node = structure_.parent(level++, node);
  const double expected = k_ + 2 * std::sqrt(static_cast<double>(k_)) + 1;
  return balls_.radius(level, node) * std::cbrt(expected / static_cast<double>(balls_.count(level, node)));
}

template <class Metric>
void LeafNearest<Metric>::search_leaf(std::int32_t leaf, NearestRows& rows) {
  // Of a view that is kept up the points are not measured.
  const double reach = structure_.measured ? guess_reach(leaf) : 0;
  if (structure_.measured && has_one_image(reach)) {
    near_.collect(metric_, leaf, reach, work_);
    if (fits(reach)) {
      for (std::int32_t block = 0; block < near_.own_blocks(); ++block) search_block(block, reach, rows);
      return;
    }
  }
  structure_.for_each_child(1, leaf,
                            [&](std::int32_t slot) { search_point(structure_.points.id[slot], rows); });
}

/// Whether points have one image within reach, and squared distances are such as float holds.
template <class Metric>
bool LeafNearest<Metric>::fits(double reach) const {
  const double most2 = limit2(reach);
  return most2 >= kLeast2 && most2 <= kMost2 && has_one_image(std::sqrt(most2) + error());
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

/// All points of a block look for candidates before the first of them is measured as it should be, so that
/// what has to come from memory comes at once.
template <class Metric>
void LeafNearest<Metric>::search_block(std::int32_t block, double reach, NearestRows& rows) {
  select(block, reach + near_.rounding());
  const std::int32_t first = block * kBlock, points = near_.points_in(block);
  std::int32_t end[kBlock];  // of the candidates of each
  candidates_.clear();
  for (std::int32_t lane = 0; lane < points; ++lane) {
    if (find(first + lane, reach))
      candidates_.insert(candidates_.end(), found_.slot, found_.slot + found_.count);
    end[lane] = static_cast<std::int32_t>(candidates_.size());
    fetch(first + lane, rows);
  }
  for (std::int32_t lane = 0; lane < points; ++lane) {
    const std::int32_t begin = lane == 0 ? 0 : end[lane - 1];
    if (!settle(first + lane, begin, end[lane], reach, rows)) search_point(near_.id(first + lane), rows);
  }
}

/// The points of the blocks within reach of one of the leaf's own.
template <class Metric>
void LeafNearest<Metric>::select(std::int32_t block, double reach) {
  const NearBlocks blocks = near_.blocks();
  const auto room = static_cast<std::size_t>(near_.count()) + kChunk;
  if (block_.size() < room) {
    block_.resize(room);
    gap2_.resize(room);
    for (auto& axis : coordinates_) axis.resize(kBlock * room);
    slots_.resize(kBlock * room);
    points_ = {{coordinates_[0].data(), coordinates_[1].data(), coordinates_[2].data()}, slots_.data()};
  }
  BoxAndReach box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = blocks.low[axis][block];
    box.high[axis] = blocks.high[axis][block];
  }
  box.reach2 = static_cast<float>(reach * reach * (1 + double{kBlur}));
  const std::int32_t count = kernels_.select(box, blocks, near_.count(), block_.data(), gap2_.data());
  if (count * kBlock > kAtOnce) sort_by_gap(count);
  point_count_ = kernels_.gather(block_.data(), count, blocks, points_);
  work_.blocks += near_.count();
}

/// The nearest blocks come first.
template <class Metric>
void LeafNearest<Metric>::sort_by_gap(std::int32_t count) {
  by_gap_.clear();
  for (std::int32_t n = 0; n < count; ++n) by_gap_.push_back({gap2_[n], block_[n]});
  std::sort(by_gap_.begin(), by_gap_.end(), [](const Selected& a, const Selected& b) {
    return a.gap2 != b.gap2 ? a.gap2 < b.gap2 : a.block < b.block;
  });
  for (std::size_t n = 0; n < by_gap_.size(); ++n) {
    gap2_[n] = by_gap_[n].gap2;
    block_[n] = by_gap_[n].block;
  }
}

/// Looks among the selected points for those that may be among the nearest of one. Returns false if there may
/// be nearer ones than what it found.
template <class Metric>
bool LeafNearest<Metric>::find(std::int32_t slot, double reach) {
  const float* const at = near_.blocks().coordinates + slot / kBlock * 3 * kBlock + slot % kBlock;
  NearestTask task{{at[0], at[kBlock], at[2 * kBlock]}, slot, static_cast<float>(limit2(reach))};
  found_.count = 0;
  for (std::int32_t first = 0; first < point_count_;) {
    if (first % kAtOnce == 0 && first > 0 && gap2_[first / kBlock] > task.reach2) break;
    const std::int32_t last = std::min(point_count_, (first / kAtOnce + 1) * kAtOnce);
    const std::int32_t stop = kernels_.search(task, points_, first, last, found_);
    work_.points += stop - first;
    first = stop;
    if (first < point_count_ && found_.count >= k_ && !shrink(task)) return false;
  }
  return found_.count >= k_ && shrink(task);
}

/// Leaves out what cannot be among the nearest, whatever rounding hides. Returns false if there is no room
/// for more then.
template <class Metric>
bool LeafNearest<Metric>::shrink(NearestTask& task) {
  const float last = k_ == 1 ? least_found() : last_found();
  task.reach2 = std::min(task.reach2, last * (1 + kBlur + 2 * kDisorder) + static_cast<float>(blur()));
  const std::int32_t count = found_.count;
  found_.count = 0;
  for (std::int32_t n = 0; n < count; ++n) {
    const float distance2 = found_.distance2[n];
    found_.distance2[found_.count] = distance2;
    found_.slot[found_.count] = found_.slot[n];
    found_.count += distance2 <= task.reach2;
  }
  return found_.count <= found_.room - kChunk;
}

template <class Metric>
float LeafNearest<Metric>::least_found() const {
  float least = found_.distance2[0];
  for (std::int32_t n = 1; n < found_.count; ++n) least = std::min(least, found_.distance2[n]);
  return least;
}

/// Puts what was found in ascending order, to within kDisorder. Returns the last distance that is wanted.
template <class Metric>
float LeafNearest<Metric>::last_found() {
  const std::int32_t count = found_.count;
  if (count <= kMostRanked) {
    rank_found(kernels_, found_, sorted_);
  } else {
    order_.resize(static_cast<std::size_t>(count));
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
      return found_.distance2[a] != found_.distance2[b] ? found_.distance2[a] < found_.distance2[b] : a < b;
    });
    for (std::int32_t n = 0; n < count; ++n) {
      sorted_.distance2[n] = found_.distance2[order_[static_cast<std::size_t>(n)]];
      sorted_.slot[n] = found_.slot[order_[static_cast<std::size_t>(n)]];
    }
  }
  sorted_.count = count;
  std::swap(found_, sorted_);
  return found_.distance2[k_ - 1];
}

/// Has what settle() needs fetched from memory: points and rows lie there anywhere.
template <class Metric>
void LeafNearest<Metric>::fetch(std::int32_t slot, const NearestRows& rows) const {
  const std::int32_t id = near_.id(slot);
  const auto row = static_cast<std::size_t>(id) * static_cast<std::size_t>(k_);
  if constexpr (!std::is_same_v<Metric, OpenMetric>) __builtin_prefetch(&structure_.raw[id]);
  __builtin_prefetch(&rows.id[row], 1);
  __builtin_prefetch(&rows.distance2[row], 1);
  __builtin_prefetch(&rows.distance2[row + static_cast<std::size_t>(k_) - 1], 1);
}

/// Fills the row of a point, given its candidates. Returns false if there may be nearer points.
template <class Metric>
bool LeafNearest<Metric>::settle(std::int32_t slot, std::int32_t first, std::int32_t last, double reach,
                                 NearestRows& rows) {
  if (last - first < k_) return false;
  best_.clear(k_);
  for (std::int32_t n = first; n < last; ++n) {
    const std::int32_t other = candidates_[static_cast<std::size_t>(n)];
    best_.add(distance2(slot, other), near_.id(other));
  }
  const double certain = reach - slack_;  // all points within this were there
  if (certain < 0 || best_.limit2() * kInflate > certain * certain) return false;
  write_row(near_.id(slot), rows);
  return true;
}

/// Of the positions as given.
template <class Metric>
double LeafNearest<Metric>::distance2(std::int32_t slot, std::int32_t other) const {
  if constexpr (std::is_same_v<Metric, OpenMetric>) {
    return OpenMetric::distance2(near_.wrapped(slot), near_.wrapped(other));
  } else {
    return structure_.box.distance2(structure_.raw[near_.id(slot)], structure_.raw[near_.id(other)]);
  }
}

template <class Metric>
void LeafNearest<Metric>::write_row(std::int32_t id, NearestRows& rows) const {
  const std::ptrdiff_t row = id * static_cast<std::ptrdiff_t>(k_);
  best_.write(rows.id.data() + row, rows.distance2.data() + row);
}

template <class Metric>
void LeafNearest<Metric>::search_point(std::int32_t id, NearestRows& rows) {
  best_.clear(k_);
  descent_.search(structure_.raw[id], id, 0, best_);
  write_row(id, rows);
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
