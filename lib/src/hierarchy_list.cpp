// SPDX-License-Identifier: MIT
//
// Neighbor lists: the level-0 edges of the conflict graph, enumerated among the descendants of equal or
// neighboring nodes of the lowest level with stored edges (Lemma 5.3.1(5), applied level by level).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "candidate_buffer.hpp"
#include "hierarchy_impl.hpp"
#include "pair_filter.hpp"
#include "position_check.hpp"
#include "sibling_store.hpp"

namespace dch {

using detail::kNone;
using detail::Level;
using detail::OpenMetric;
using detail::with_metric;

namespace {

/// Finds the pairs of one list.
template <class Metric>
class PairCollector {
 public:
  PairCollector(const Metric& metric, const detail::PairFilter& filter, detail::PairBuffer& pairs)
      : metric_(metric), filter_(filter), pairs_(pairs) {}

  void from_roots(const Level& points) {
    for (std::int32_t k = 0; k < points.size(); ++k)
      near_.append_if(points.is_alive(k), points.position[k], points.id[k]);
    test_all(metric_, near_.size());
  }

  /// Each cluster with itself and with its neighbors of higher index.
  ///
  /// Positions are taken relative to the center of the cluster at hand where that names every image rightly:
  /// the centers of a pair within r_list are within r_list plus both extents; below half the smallest height
  /// of the box only one image is so near. No test needs a nearest image then. What this adds in rounding is
  /// left to the filter's band.
  void from_clusters(const std::vector<Level>& levels, int cluster_level, const ListParams& request,
                     double max_cutoff) {
    const Level& centers = levels[cluster_level];
    const bool are_roots = cluster_level + 1 == static_cast<int>(levels.size());
    const double list_radius = std::sqrt(filter_.largest_distance2());
    siblings_.fill(levels, cluster_level);
    const double largest_extent = measure_clusters(levels[0], centers, request.first_ghost);
    const bool relative = (list_radius + 2 * largest_extent) * kInflate < max_cutoff;
    if (relative) make_relative(centers);
    for (std::int32_t center = 0; center < centers.size(); ++center) {
      if (!centers.is_alive(center)) continue;
      const double reach = (list_radius + extent_[center]) * kInflate;
      near_.clear();
      for (std::int32_t k = siblings_.first[center]; k < siblings_.first[center + 1]; ++k)
        near_.append_if(true, siblings_.position[k], siblings_.node[k]);
      const std::size_t own_count = near_.size();
      const Vec3 origin = centers.position[center];
      const auto visit = [&](std::int32_t neighbor) {
        if (neighbor <= center || !(owned_[center] || owned_[neighbor])) return;
        const Vec3 between = metric_.displacement(origin, centers.position[neighbor]);
        const double limit = reach + extent_[neighbor] * kInflate;
        if (norm2(between) > limit * limit) return;
        if (relative) {
          gather(neighbor, between, reach * reach, [](Vec3 at) { return norm2(at); });
        } else {
          gather(neighbor, {}, reach * reach, [&](Vec3 at) { return metric_.distance2(origin, at); });
        }
      };
      if (are_roots) {
        for (std::int32_t other = center + 1; other < centers.size(); ++other)
          if (centers.is_alive(other)) visit(other);
      } else {
        for (const std::int32_t neighbor : centers.edges.row(center)) visit(neighbor);
      }
      if (relative) {
        test_all(OpenMetric(Box::none()), own_count);
      } else {
        test_all(metric_, own_count);
      }
    }
  }

 private:
  /// How far each cluster reaches, which is less than the sum of the radii below it, and whether any of it is
  /// not a ghost. Returns the largest reach; makes the stored nodes ids.
  double measure_clusters(const Level& points, const Level& centers, std::int32_t first_ghost) {
    extent_.assign(centers.position.size(), 0);
    owned_.assign(centers.position.size(), first_ghost < 0);
    double largest = 0;
    for (std::int32_t center = 0; center < centers.size(); ++center) {
      double extent2 = 0;
      for (std::int32_t k = siblings_.first[center]; k < siblings_.first[center + 1]; ++k) {
        extent2 = std::max(extent2, metric_.distance2(centers.position[center], siblings_.position[k]));
        siblings_.node[k] = points.id[siblings_.node[k]];
        if (siblings_.node[k] < first_ghost) owned_[center] = true;
      }
      extent_[center] = std::sqrt(extent2);
      largest = std::max(largest, extent_[center]);
    }
    return largest;
  }

  void make_relative(const Level& centers) {
    for (std::int32_t center = 0; center < centers.size(); ++center)
      for (std::int32_t k = siblings_.first[center]; k < siblings_.first[center + 1]; ++k)
        siblings_.position[k] = metric_.displacement(centers.position[center], siblings_.position[k]);
  }

  template <class Distance2>
  void gather(std::int32_t cluster, Vec3 shift, double reach2, const Distance2& distance2) {
    const std::int32_t begin = siblings_.first[cluster];
    const auto count = static_cast<std::size_t>(siblings_.first[cluster + 1] - begin);
    near_.append_within(siblings_.position.data() + begin, siblings_.node.data() + begin, count, shift,
                        distance2, reach2);
  }

  /// The first `own_count` points with each other and with all that follow. A few neighbors in the order of
  /// the hierarchy are close to each other, so most candidates are dismissed for all of them at once.
  template <class PairMetric>
  void test_all(const PairMetric& metric, std::size_t own_count) {
    constexpr std::size_t kBlock = 4;
    const double list_radius = std::sqrt(filter_.largest_distance2());
    for (std::size_t begin = 0; begin < own_count; begin += kBlock) {
      const std::size_t end = std::min(begin + kBlock, own_count);
      const Vec3 pivot = near_.position(begin + (end - begin) / 2);
      double extent2 = 0;
      for (std::size_t a = begin; a < end; ++a)
        extent2 = std::max(extent2, metric.distance2(pivot, near_.position(a)));
      const double reach = (list_radius + std::sqrt(extent2)) * kInflate;
      block_.assign_selected(near_, near_.select(metric, pivot, begin, reach * reach));
      for (std::size_t a = 0; a < end - begin; ++a) test_point(metric, a);
    }
  }

  /// Point `a` of the block, all of whose points come first, with the points after it.
  template <class PairMetric>
  void test_point(const PairMetric& metric, std::size_t a) {
    const std::int32_t i = block_.node(a);
    const std::size_t hits = block_.select(metric, block_.position(a), a + 1, filter_.largest_distance2());
    for (std::size_t h = 0; h < hits; ++h) {
      const std::size_t b = block_.hit(h);
      if (filter_.accept(i, block_.node(b), block_.distance2(b))) pairs_.add(i, block_.node(b));
    }
  }

  const Metric& metric_;
  const detail::PairFilter& filter_;
  detail::PairBuffer& pairs_;
  detail::SiblingStore siblings_;
  std::vector<double> extent_;     ///< by center: distance of the farthest child [length]
  std::vector<char> owned_;        ///< by center: whether a child is not a ghost
  detail::CandidateBuffer block_;  ///< what of near_ is in reach of the block at hand, its own points first
  detail::CandidateBuffer near_;   ///< ids: the cluster's own points, then the candidates around it
};

}  // namespace

void Hierarchy::Impl::list(const ListParams& request, NeighborList& out) {
  const auto start = std::chrono::steady_clock::now();
  detail::check_list_params(request, raw.size(), params.radius);
  const detail::WrapError wrap(box);
  const double wrap_error = wrap.bound(wrap.largest_reach(raw));
  if (wrap_error > wrap_slack) {  // points inserted since the last update lie much farther out
    set_wrap_slack(raw);
    with_metric(box, [&](const auto& metric) { repair(metric, 0); });
  }
  const double rounding =
      32 * std::numeric_limits<double>::epsilon() * params.radius;  // of relative positions
  const detail::PairFilter filter(raw, box, request, wrap_error + rounding);
  pairs.clear();
  with_metric(box, [&](const auto& metric) {
    PairCollector collector(metric, filter, pairs);
    if (top() == 0) {
      collector.from_roots(levels[0]);
    } else {
      collector.from_clusters(levels, std::min(kFirstStoredLevel, top()), request, box.max_cutoff());
    }
  });
  assembler.assemble(raw.size(), request.kind, request.first_ghost, pairs, out);
  stats.list_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Metric>
void Hierarchy::Impl::neighbors(const Metric& metric, int i, std::int32_t node,
                                std::vector<std::int32_t>& nodes) const {
  const Level& level = levels[i];
  if (stores_edges(i)) {
    const auto stored = level.edges.row(node);
    nodes.insert(nodes.end(), stored.begin(), stored.end());
    return;
  }
  const auto look_at = [&](std::int32_t other) {
    if (other != node && metric.distance2(level.position[node], level.position[other]) <= level.threshold2)
      nodes.push_back(other);
  };
  if (i == top()) {
    for (std::int32_t k = 0; k < level.size(); ++k)
      if (level.is_alive(k)) look_at(k);
    return;
  }
  std::vector<std::int32_t> parents{level.parent[node]};
  neighbors(metric, i + 1, level.parent[node], parents);
  for (const std::int32_t parent : parents)
    for (std::int32_t k = levels[i + 1].first_child[parent]; k != kNone; k = level.next_sibling[k])
      look_at(k);
}

#define DCH_INSTANTIATE(Metric)                                                                          \
  template void Hierarchy::Impl::neighbors(const Metric&, int, std::int32_t, std::vector<std::int32_t>&) \
      const;
DCH_INSTANTIATE(detail::OpenMetric)
DCH_INSTANTIATE(detail::OrthorhombicMetric)
DCH_INSTANTIATE(detail::LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch
