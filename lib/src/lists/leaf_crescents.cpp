// SPDX-License-Identifier: MIT
#include "lists/leaf_crescents.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/metric.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

/// Of offsets in float and what is computed from them, relative to the extent of a leaf; with room to spare.
constexpr double kRoundings = 16 * 0x1p-24;

double square(double v) { return v * v; }

/// Squared distances of a place from the nearest and from the farthest point of a box.
double nearest2(const MeasuredLeaves::Corners& box, Vec3 p) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis)
    sum += square(std::max({box.low[axis] - p[axis], p[axis] - box.high[axis], 0.0}));
  return sum;
}
double farthest2(const MeasuredLeaves::Corners& box, Vec3 p) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis)
    sum += square(std::max(box.high[axis] - p[axis], p[axis] - box.low[axis]));
  return sum;
}

}  // namespace

// What is put off is certified: for each leaf the sum of its extent and of its center's motion is within half
// of what rho_1 exceeds the radius by, and singletons keep within that of what they were beyond (see
// Hierarchy::Impl::edges_are_certified).
template <class Metric>
LeafCrescents<Metric>::LeafCrescents(const Metric& metric, const Structure& structure)
    : metric_(metric),
      structure_(structure),
      motion_(structure.pending ? structure.motion : 0),
      others_(structure.leaves.largest_extent),
      singletons_(0),
      shortest_(structure.box.shortest_period()) {
  if (!structure.pending) return;
  const double certified =
      0.5 * (structure.levels[1].threshold - structure.wrap_slack - structure.params.radius);
  others_ = structure.singletons.empty() ? std::min(certified, others_ + motion_) : certified;
  singletons_ = structure.singletons.empty() ? 0 : certified;
}

template <class Metric>
bool LeafCrescents<Metric>::any(const Crescent& crescent, std::int32_t own, const Test& test) const {
  if (own != kNone && edges_reach(crescent, own)) {
    if (any_in_leaf(crescent, own, test)) return true;
    const auto others = structure_.levels[1].edges.row(own);
    return std::any_of(others.begin(), others.end(),
                       [&](std::int32_t leaf) { return any_in_leaf(crescent, leaf, test); });
  }
  const std::vector<Level>& levels = structure_.levels;
  double reach = (crescent.outer + structure_.leaves.largest_extent + singletons_) * kInflate;
  for (int level = 1; level < structure_.top(); ++level)
    reach += (levels[level].radius + 2 * motion_) * kInflate;
  const Level& roots = levels.back();
  for (std::int32_t root = 0; root < roots.size(); ++root)
    if (roots.is_alive(root) && any_below(crescent, structure_.top(), root, reach, test)) return true;
  return false;
}

/// Whether all points in the crescent are in the leaf or in those that edges join to it: two leaves without
/// an edge had centers more than rho_1 apart when the edges were made.
template <class Metric>
bool LeafCrescents<Metric>::edges_reach(const Crescent& crescent, std::int32_t own) const {
  const Level& centers = structure_.levels[1];
  double needed =
      std::sqrt(metric_.distance2(centers.position[own], crescent.now)) + crescent.outer + others_;
  if (structure_.pending)
    needed += std::sqrt(metric_.distance2(structure_.anchors[own], centers.position[own]));
  return needed * kInflate <= centers.threshold - structure_.wrap_slack;
}

/// A descent: nodes of level i have those of level 1 that are below them within R_1 + ... + R_{i-1}, and
/// twice the motion a level; and singletons.
template <class Metric>
bool LeafCrescents<Metric>::any_below(const Crescent& crescent, int level, std::int32_t node, double reach,
                                      const Test& test) const {
  const Level& own = structure_.levels[level];
  if (metric_.distance2(crescent.now, own.position[node]) > reach * reach) return false;
  if (level == 1) return any_in_leaf(crescent, node, test);
  if (structure_.is_singleton(level, node)) {
    const std::int32_t id = own.id[node];
    return metric_.distance2(crescent.now, metric_.wrap(structure_.raw[id])) <= square(crescent.outer) &&
           test(id);
  }
  const Level& below = structure_.levels[level - 1];
  const double left = reach - (below.radius + 2 * motion_) * kInflate;
  for (std::int32_t child = own.first_child[node]; child != kNone; child = below.next_sibling[child])
    if (any_below(crescent, level - 1, child, left, test)) return true;
  return false;
}

template <class Metric>
bool LeafCrescents<Metric>::any_in_leaf(const Crescent& crescent, std::int32_t leaf, const Test& test) const {
  const MeasuredLeaves& measured = structure_.leaves;
  const MeasuredLeaves::Leaf& own = measured.leaves[leaf];
  const Vec3 center = structure_.levels[1].position[leaf];
  const double rounding = kRoundings * own.extent;
  const Vec3 now = metric_.displacement(center, crescent.now);
  const double farthest = crescent.outer + own.extent + rounding;
  if (norm2(now) > farthest * farthest * kInflate) return false;
  const Vec3 then = metric_.displacement(center, crescent.then);
  const double inside = crescent.inner - own.extent - rounding;
  if (inside > 0 && norm2(then) <= inside * inside) return false;
  const bool one_image = 2 * farthest * kInflate < shortest_;
  for (std::int32_t b = own.first_block; b < own.first_block + own.blocks; ++b)
    if (one_image ? any_in_block(crescent, b, then, now, rounding, test) : any_image(crescent, b, test))
      return true;
  return false;
}

/// Where no other image of the leaf is as near.
template <class Metric>
bool LeafCrescents<Metric>::any_in_block(const Crescent& crescent, std::int32_t block, Vec3 then, Vec3 now,
                                         double rounding, const Test& test) const {
  const MeasuredLeaves& measured = structure_.leaves;
  const double outer2 = square(crescent.outer + rounding), inner = crescent.inner - rounding,
               inner2 = inner > 0 ? inner * inner : -1;
  const MeasuredLeaves::Corners& box = measured.corners[block];
  if (nearest2(box, now) > outer2 || farthest2(box, then) <= inner2) return false;
  const MeasuredLeaves::Offsets& at = measured.offsets[block];
  const std::int32_t* const ids =
      structure_.points.id.data() + std::size_t{kBlock} * static_cast<std::size_t>(measured.source[block]);
  for (int lane = 0; lane < measured.count[block]; ++lane) {
    const Vec3 p{at.axis[0][lane], at.axis[1][lane], at.axis[2][lane]};
    if (norm2(p - now) <= outer2 && norm2(p - then) > inner2 && test(ids[lane])) return true;
  }
  return false;
}

template <class Metric>
bool LeafCrescents<Metric>::any_image(const Crescent& crescent, std::int32_t block, const Test& test) const {
  const LeafBlocks& points = structure_.points;
  const std::int32_t first = structure_.leaves.source[block] * kBlock;
  for (std::int32_t slot = first; slot < first + structure_.leaves.count[block]; ++slot)
    if (metric_.distance2(crescent.now, points.position[slot]) <= square(crescent.outer) * kInflate &&
        test(points.id[slot]))
      return true;
  return false;
}

template class LeafCrescents<OpenMetric>;
template class LeafCrescents<OrthorhombicMetric>;
template class LeafCrescents<LatticeMetric>;

}  // namespace dch::detail
