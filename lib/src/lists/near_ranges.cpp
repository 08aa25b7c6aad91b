// SPDX-License-Identifier: MIT
#include "lists/near_ranges.hpp"

#include "geometry/metric.hpp"
#include "geometry/near_images.hpp"
#include "geometry/tolerance.hpp"
#include "leaves/rounding.hpp"
#include "lists/leaf_search.hpp"

namespace dch::detail {
template <class Metric>
void NearRanges<Metric>::add(const LeafSource& leaves, const Leaf& other, Vec3 between) {
  BlockRange range{};
  range.first = other.first_block;
  range.count = other.blocks;
  for (int axis = 0; axis < 3; ++axis) {
    range.box_shift[axis] = rounded(between[axis] * leaves.quantized.per_unit.box);
    range.point_shift[axis] = rounded(between[axis] * leaves.quantized.per_unit.point);
  }
  ranges_.push_back(range);
}

template <class Metric>
void NearRanges<Metric>::add_if_near(const NearSource& near, const Leaf& other, Vec3 between) {
  const double limit = (near.reach + own_.extent + other.extent) * kInflate;
  if (norm2(between) <= limit * limit) add(*near.source, other, between);
}

/// All images of a leaf that are near; of a leaf and itself each pair of images once.
template <class Metric>
void NearRanges<Metric>::add_images(const NearSource& near, std::int32_t other) {
  const Leaf& other_leaf = near.source->measured().leaves[other];
  const bool is_itself = near.source == &rows_ && k_ == other;
  const Vec3 nearest = metric_.displacement(center_, near.source->centers().position[other]);
  const double limit = (near.reach + own_.extent + other_leaf.extent) * kInflate;
  for_each_near_image(box_, nearest, limit, is_itself,
                      [&](Vec3 between) { add(*near.source, other_leaf, between); });
}

template <class Metric>
void NearRanges<Metric>::find_own(const NearSource& near) {
  const std::vector<Leaf>& leaves = near.source->measured().leaves;
  const Level& centers = near.source->centers();
  ranges_.clear();
  add(*near.source, own_, Vec3{});
  if (!near.one_image) add_images(near, k_);
  for (const std::int32_t other : centers.edges.row(k_)) {
    if (other < k_ || !(own_owned_ || near.source->labelled.leaf_owned[other])) continue;
    if (near.one_image) {
      add_if_near(near, leaves[other], metric_.displacement(center_, centers.position[other]));
    } else {
      add_images(near, other);
    }
  }
}

template <class Metric>
std::int64_t NearRanges<Metric>::find_others(const NearSource& near) {
  const MeasuredLeaves& others = near.source->measured();
  ranges_.clear();
  const double radius = (near.reach + own_.extent + others.largest_extent) * kInflate;
  return for_each_leaf_near(metric_, *near.source, center_, radius, [&](std::int32_t other) {
    if (!(own_owned_ || near.source->labelled.leaf_owned[other])) return;
    if (near.one_image) {
      add_if_near(near, others.leaves[other],
                  metric_.displacement(center_, near.source->centers().position[other]));
    } else {
      add_images(near, other);
    }
  });
}

template class NearRanges<OpenMetric>;
template class NearRanges<OrthorhombicMetric>;
template class NearRanges<LatticeMetric>;

}  // namespace dch::detail
