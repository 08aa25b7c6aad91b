// SPDX-License-Identifier: MIT
#include "lists/near_ranges.hpp"

#include <algorithm>

#include "geometry/metric.hpp"
#include "geometry/near_images.hpp"
#include "geometry/tolerance.hpp"
#include "leaves/leaf_frame.hpp"
#include "leaves/rounding.hpp"
#include "lists/leaf_search.hpp"

namespace dch::detail {
/// @param between the centers of leaf k and of the other one
template <class Metric>
void NearRanges<Metric>::add(const LeafSource& leaves, std::int32_t other, Vec3 between) {
  const Leaf& other_leaf = leaves.measured().leaves[other];
  const Vec3 origins = between + (leaves.quantized.origin[other] - rows_.quantized.origin[k_]);
  BlockRange range{};
  range.first = other_leaf.first_block;
  range.count = other_leaf.blocks;
  for (int axis = 0; axis < 3; ++axis) {
    range.box_shift[axis] = rounded(between[axis] * leaves.quantized.per_unit.box);
    split_shift(origins[axis] * leaves.quantized.per_unit.point, range.point_shift[axis]);
  }
  ranges_.push_back(range);
}

/// How far centers may be apart whose leaves are near.
template <class Metric>
double NearRanges<Metric>::limit_with(const NearSource& near, const Leaf& other) const {
  return (near.reach + own_.extent + other.extent) * kInflate;
}

template <class Metric>
void NearRanges<Metric>::add_if_near(const NearSource& near, std::int32_t other, Vec3 between) {
  const double limit = limit_with(near, near.source->measured().leaves[other]);
  if (norm2(between) <= limit * limit) add(*near.source, other, between);
}

/// All images of a leaf that are near; of a leaf and itself each pair of images once.
template <class Metric>
void NearRanges<Metric>::add_images(const NearSource& near, std::int32_t other) {
  const bool is_itself = near.source == &rows_ && k_ == other;
  const Vec3 nearest = metric_.displacement(center_, near.source->centers().position[other]);
  const double limit = limit_with(near, near.source->measured().leaves[other]);
  for_each_near_image(box_, nearest, limit, is_itself,
                      [&](Vec3 between) { add(*near.source, other, between); });
}

template <class Metric>
void NearRanges<Metric>::find_own(const NearSource& near) {
  const Level& centers = near.source->centers();
  ranges_.clear();
  add(*near.source, k_, Vec3{});
  if (!near.one_image) add_images(near, k_);
  const Span<const std::int32_t> joined = centers.edges.row(k_);
  for (std::size_t first = 0; first < joined.size(); first += kAtATime)
    add_joined(near, joined.data() + first, std::min(kAtATime, joined.size() - first));
}

/// Which leaves come later, and which of them are near, is hard to foretell: so both are found without
/// branches.
template <class Metric>
void NearRanges<Metric>::add_joined(const NearSource& near, const std::int32_t* joined, std::size_t count) {
  const std::vector<Leaf>& leaves = near.source->measured().leaves;
  const std::vector<Vec3>& centers = near.source->centers().position;
  const std::uint8_t* const owned = near.source->labelled.leaf_owned.data();
  std::int32_t later[kAtATime];
  std::size_t met = 0;
  for (std::size_t e = 0; e < count; ++e) {
    const std::int32_t other = later[met] = joined[e];
    met += static_cast<std::size_t>(other > k_) & static_cast<std::size_t>(own_owned_ | (owned[other] != 0));
  }
  if (!near.one_image) {
    for (std::size_t e = 0; e < met; ++e) add_images(near, later[e]);
    return;
  }
  Vec3 between[kAtATime];
  std::size_t kept = 0;
  for (std::size_t e = 0; e < met; ++e) {
    const std::int32_t other = later[kept] = later[e];
    between[kept] = metric_.displacement(center_, centers[other]);
    const double limit = limit_with(near, leaves[other]);
    kept += static_cast<std::size_t>(norm2(between[kept]) <= limit * limit);
  }
  for (std::size_t e = 0; e < kept; ++e) add(*near.source, later[e], between[e]);
}

template <class Metric>
std::int64_t NearRanges<Metric>::find_others(const NearSource& near) {
  const MeasuredLeaves& others = near.source->measured();
  ranges_.clear();
  const double radius = (near.reach + own_.extent + others.largest_extent) * kInflate;
  return for_each_leaf_near(metric_, *near.source, center_, radius, [&](std::int32_t other) {
    if (!(own_owned_ || near.source->labelled.leaf_owned[other])) return;
    if (near.one_image) {
      add_if_near(near, other, metric_.displacement(center_, near.source->centers().position[other]));
    } else {
      add_images(near, other);
    }
  });
}

template class NearRanges<OpenMetric>;
template class NearRanges<OrthorhombicMetric>;
template class NearRanges<LatticeMetric>;

}  // namespace dch::detail
