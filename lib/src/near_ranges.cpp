// SPDX-License-Identifier: MIT
#include "near_ranges.hpp"

#include "metric.hpp"
#include "near_images.hpp"

namespace dch::detail {
namespace {

/// Candidate radii (never decisions) are inflated by this factor.
constexpr double kInflateReach = 1 + 1e-12;

}  // namespace

template <class Metric>
void NearRanges<Metric>::add(const ClusterPoints& points, const Cluster& other, Vec3 between) {
  BlockRange range{};
  range.first = other.first_block;
  range.count = other.blocks;
  for (int axis = 0; axis < 3; ++axis) {
    range.box_shift[axis] = rounded(between[axis] * points.per_unit.box);
    range.point_shift[axis] = rounded(between[axis] * points.per_unit.point);
  }
  ranges_.push_back(range);
}

template <class Metric>
void NearRanges<Metric>::add_if_near(const NearSource& near, const Cluster& other, Vec3 between) {
  const double limit = (near.reach + own_.extent + other.extent) * kInflateReach;
  if (norm2(between) <= limit * limit) add(*near.source->points, other, between);
}

/// All images of a cluster that are near; of a cluster and itself each pair of images once.
template <class Metric>
void NearRanges<Metric>::add_images(const NearSource& near, std::int32_t other) {
  const Cluster& other_cluster = near.source->points->clusters[other];
  const bool is_itself = near.source == &rows_ && k_ == other;
  const Vec3 nearest = metric_.displacement(center_, near.source->centers().position[other]);
  const double limit = (near.reach + own_.extent + other_cluster.extent) * kInflateReach;
  for_each_near_image(box_, nearest, limit, is_itself,
                      [&](Vec3 between) { add(*near.source->points, other_cluster, between); });
}

template <class Metric>
void NearRanges<Metric>::find_own(const NearSource& near) {
  const std::vector<Cluster>& clusters = near.source->points->clusters;
  const Level& centers = near.source->centers();
  ranges_.clear();
  add(*near.source->points, own_, Vec3{});
  if (!near.one_image) add_images(near, k_);
  for (const std::int32_t other : centers.edges.row(k_)) {
    if (other < k_ || !(own_.owned || clusters[other].owned)) continue;
    if (near.one_image) {
      add_if_near(near, clusters[other], metric_.displacement(center_, centers.position[other]));
    } else {
      add_images(near, other);
    }
  }
}

template <class Metric>
std::int64_t NearRanges<Metric>::find_others(const NearSource& near) {
  const ClusterPoints& others = *near.source->points;
  ranges_.clear();
  const double radius = (near.reach + own_.extent + others.largest_extent) * kInflateReach;
  return for_each_cluster_near(metric_, *near.source, center_, radius, [&](std::int32_t other) {
    if (!(own_.owned || others.clusters[other].owned)) return;
    if (near.one_image) {
      add_if_near(near, others.clusters[other],
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
