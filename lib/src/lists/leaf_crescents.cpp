// SPDX-License-Identifier: MIT
#include "lists/leaf_crescents.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/metric.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

/// Of coordinates in float and the distances computed from them, relative to the largest; with room to spare.
constexpr double kFloatRounding = 16 * 0x1p-24;

/// Crescents smaller than this, or larger than its inverse, are looked at in double.
constexpr double kLeastFloat = 1e-12;

double square(double v) { return v * v; }

/// A crescent as seen from the center of a leaf, in float and wider by what that rounds.
struct NearCrescent {
  NearCrescent(const Crescent& crescent, Vec3 to_middle, double rounding)
      : radius2(static_cast<float>(square(crescent.radius + rounding))),
        outer2(static_cast<float>(square(crescent.outer + rounding))),
        inner2(crescent.inner > rounding ? static_cast<float>(square(crescent.inner - rounding)) : -1) {
    for (int axis = 0; axis < 3; ++axis) {
      middle[axis] = static_cast<float>(to_middle[axis]);
      now[axis] = static_cast<float>(to_middle[axis] - crescent.from_now[axis]);
      then[axis] = static_cast<float>(to_middle[axis] - crescent.from_then[axis]);
    }
  }
  float middle[3], now[3], then[3];
  float radius2, outer2, inner2;
};

float larger(float a, float b) { return a > b ? a : b; }

/// Squared distances of a place from the nearest and from the farthest point of a box.
float nearest2(const MeasuredLeaves::Corners& box, const float* p) {
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float gap = larger(larger(box.low[axis] - p[axis], p[axis] - box.high[axis]), 0);
    sum += gap * gap;
  }
  return sum;
}
float farthest2(const MeasuredLeaves::Corners& box, const float* p) {
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float away = larger(box.high[axis] - p[axis], p[axis] - box.low[axis]);
    sum += away * away;
  }
  return sum;
}

bool may_meet(const MeasuredLeaves::Corners& box, const NearCrescent& crescent) {
  return nearest2(box, crescent.middle) <= crescent.radius2 &&
         farthest2(box, crescent.then) > crescent.inner2 && nearest2(box, crescent.now) <= crescent.outer2;
}

/// The lanes of a block with points in the crescent: a bit for each, and any bits for lanes without a point.
unsigned lanes_in(const MeasuredLeaves::Offsets& at, const NearCrescent& crescent) {
  const auto [x, y, z] = at.axis;
  unsigned in[kBlock];
  for (int lane = 0; lane < kBlock; ++lane) {
    const float nx = x[lane] - crescent.now[0], ny = y[lane] - crescent.now[1],
                nz = z[lane] - crescent.now[2], tx = x[lane] - crescent.then[0],
                ty = y[lane] - crescent.then[1], tz = z[lane] - crescent.then[2];
    const unsigned is_near = nx * nx + ny * ny + nz * nz <= crescent.outer2 ? 1 : 0;
    const unsigned is_far = tx * tx + ty * ty + tz * tz > crescent.inner2 ? 1 : 0;
    in[lane] = (is_near & is_far) << lane;
  }
  unsigned lanes = 0;
  for (const unsigned bit : in) lanes |= bit;
  return lanes;
}

}  // namespace

// What is put off is certified: for each leaf the sum of its extent and of its center's motion is within half
// of what rho_1 exceeds the radius by, and singletons keep within that of what they were beyond (see
// Hierarchy::Impl::edges_are_certified).
template <class Metric>
LeafCrescents<Metric>::LeafCrescents(const Metric& metric, const Structure& structure)
    : metric_(metric),
      structure_(structure),
      offsets_(metric, structure.raw, structure.points),
      motion_(structure.pending ? structure.motion : 0),
      others_(structure.leaves.largest_extent),
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
  double reach = (crescent.radius + structure_.leaves.largest_extent + singletons_) * kInflate;
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
      std::sqrt(metric_.distance2(centers.position[own], crescent.middle)) + crescent.radius + others_;
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
  if (metric_.distance2(crescent.middle, own.position[node]) > reach * reach) return false;
  if (level == 1) return any_in_leaf(crescent, node, test);
  if (structure_.is_singleton(level, node)) {
    const std::int32_t id = own.id[node];
    return is_near(crescent, metric_.wrap(structure_.raw[id])) && test(id);
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
  const Vec3 middle = metric_.displacement(structure_.levels[1].position[leaf], crescent.middle);
  const double farthest = (crescent.radius + own.extent) * kInflate;
  if (norm2(middle) > farthest * farthest) return false;
  const double inside = crescent.inner - own.extent;
  if (inside > 0 && norm2(middle - crescent.from_then) * kInflate <= inside * inside) return false;
  const std::int32_t end = own.first_block + own.blocks;
  // Floats hold squares of such lengths, and a leaf has one image as near if the box is not small.
  const bool is_ordinary = crescent.outer > kLeastFloat && crescent.outer < 1 / kLeastFloat;
  if (!is_ordinary || !(2 * farthest < shortest_)) {
    for (std::int32_t b = own.first_block; b < end; ++b)
      if (any_image(crescent, b, test)) return true;
    return false;
  }
  const NearCrescent near(crescent, middle,
                          kFloatRounding * (own.extent + crescent.outer + crescent.inner + farthest));
  for (std::int32_t b = own.first_block; b < end; ++b) {
    if (!may_meet(measured.corners[b], near)) continue;
    MeasuredLeaves::Offsets found;
    if (measured.offsets.empty())
      offsets_.find(measured.source[b], structure_.levels[1].position[leaf], found);
    unsigned lanes =
        lanes_in(measured.offsets.empty() ? found : measured.offsets[b], near) & measured.lanes[b];
    const std::int32_t* const ids =
        structure_.points.id.data() + std::size_t{kBlock} * static_cast<std::size_t>(measured.source[b]);
    for (; lanes != 0; lanes &= lanes - 1)
      if (test(ids[__builtin_ctz(lanes)])) return true;
  }
  return false;
}

template <class Metric>
bool LeafCrescents<Metric>::any_image(const Crescent& crescent, std::int32_t block, const Test& test) const {
  const LeafBlocks& points = structure_.points;
  const std::int32_t first = structure_.leaves.source[block] * kBlock;
  for (std::int32_t slot = first; slot < first + structure_.leaves.count[block]; ++slot)
    if (is_near(crescent, structure_.position_in(slot, metric_)) && test(points.id[slot])) return true;
  return false;
}

template <class Metric>
bool LeafCrescents<Metric>::is_near(const Crescent& crescent, Vec3 wrapped) const {
  return metric_.distance2(crescent.middle, wrapped) <= square(crescent.radius * kInflate);
}

template class LeafCrescents<OpenMetric>;
template class LeafCrescents<OrthorhombicMetric>;
template class LeafCrescents<LatticeMetric>;

}  // namespace dch::detail
