// SPDX-License-Identifier: MIT
//
// Neighbor lists: the level-0 edges of the conflict graph, enumerated among the children of equal or
// neighboring parents (Lemma 5.3.1(5)).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <type_traits>

#include "candidate_buffer.hpp"
#include "hierarchy_impl.hpp"
#include "pair_filter.hpp"
#include "position_check.hpp"

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

  /// Each cluster with itself and with its neighbors of higher index. Where a ball of r_list + R_0 around a
  /// center meets no point twice, positions relative to the center spare every test its nearest image; what
  /// they add in rounding, a few eps of the box, is well within the band that the filter looks at again.
  void from_clusters(const Level& points, const Level& centers, const ListParams& request,
                     double max_cutoff) {
    const double list_radius = request.list_radius();
    const bool relative =
        !std::is_same_v<Metric, OpenMetric> && (list_radius + points.radius) * kInflate < max_cutoff;
    measure_clusters(points, centers, request.first_ghost);
    for (std::int32_t center = 0; center < centers.size(); ++center) {
      if (!centers.is_alive(center)) continue;
      const Vec3 origin = centers.position[center];
      const double reach = (list_radius + extent_[center]) * kInflate;
      near_.clear();
      const auto gather = [&](std::int32_t cluster) {
        for (std::int32_t k = centers.first_child[cluster]; k != kNone; k = points.next_sibling[k]) {
          const Vec3 offset = metric_.displacement(origin, points.position[k]);
          near_.append_if(norm2(offset) <= reach * reach, relative ? offset : points.position[k],
                          points.id[k]);
        }
      };
      gather(center);
      const std::size_t own_count = near_.size();
      for (const std::int32_t neighbor : centers.edges.row(center)) {
        if (neighbor < center || !(owned_[center] || owned_[neighbor])) continue;
        const double limit = reach + extent_[neighbor] * kInflate;
        if (metric_.distance2(origin, centers.position[neighbor]) <= limit * limit) gather(neighbor);
      }
      if (relative) {
        test_all(OpenMetric(Box::none()), own_count);
      } else {
        test_all(metric_, own_count);
      }
    }
  }

 private:
  /// How far each cluster really reaches, which is less than R_0, and whether any of it is not a ghost.
  void measure_clusters(const Level& points, const Level& centers, std::int32_t first_ghost) {
    extent_.assign(centers.position.size(), 0);
    owned_.assign(centers.position.size(), first_ghost < 0);
    for (std::int32_t center = 0; center < centers.size(); ++center) {
      double extent2 = 0;
      for (std::int32_t k = centers.first_child[center]; k != kNone; k = points.next_sibling[k]) {
        extent2 = std::max(extent2, metric_.distance2(centers.position[center], points.position[k]));
        if (points.id[k] < first_ghost) owned_[center] = true;
      }
      extent_[center] = std::sqrt(extent2);
    }
  }

  /// The first `own_count` points with each other and with all that follow.
  template <class PairMetric>
  void test_all(const PairMetric& metric, std::size_t own_count) {
    for (std::size_t a = 0; a < own_count; ++a) {
      const std::int32_t i = near_.node(a);
      const std::size_t hits = near_.select(metric, near_.position(a), a + 1, filter_.largest_distance2());
      for (std::size_t h = 0; h < hits; ++h) {
        const std::size_t b = near_.hit(h);
        if (filter_.accept(i, near_.node(b), near_.distance2(b))) pairs_.add(i, near_.node(b));
      }
    }
  }

  const Metric& metric_;
  const detail::PairFilter& filter_;
  detail::PairBuffer& pairs_;
  std::vector<double> extent_;    ///< by center: distance of the farthest child [length]
  std::vector<char> owned_;       ///< by center: whether a child is not a ghost
  detail::CandidateBuffer near_;  ///< ids: the cluster's own points, then the candidates around it
};

}  // namespace

void Hierarchy::Impl::list(const ListParams& request, NeighborList& out) {
  const auto start = std::chrono::steady_clock::now();
  detail::check_list_params(request, raw.size(), params.radius);
  const detail::WrapError wrap_error(box);
  const detail::PairFilter filter(raw, box, request, wrap_error.bound(wrap_error.largest_reach(raw)));
  pairs.clear();
  with_metric(box, [&](const auto& metric) {
    PairCollector collector(metric, filter, pairs);
    if (top() == 0) {
      collector.from_roots(levels[0]);
    } else {
      collector.from_clusters(levels[0], levels[1], request, box.max_cutoff());
    }
  });
  assembler.assemble(raw.size(), request.kind, request.first_ghost, pairs, out);
  stats.list_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Metric>
void Hierarchy::Impl::neighbors_of_point(const Metric& metric, std::int32_t slot,
                                         std::vector<std::int32_t>& slots) const {
  const Level& points = levels[0];
  const auto look_at = [&](std::int32_t other) {
    if (other != slot && metric.distance2(points.position[slot], points.position[other]) <= points.threshold2)
      slots.push_back(other);
  };
  if (top() == 0) {
    for (std::int32_t k = 0; k < points.size(); ++k)
      if (points.is_alive(k)) look_at(k);
    return;
  }
  const Level& centers = levels[1];
  const auto look_at_children = [&](std::int32_t center) {
    for (std::int32_t k = centers.first_child[center]; k != kNone; k = points.next_sibling[k]) look_at(k);
  };
  const std::int32_t parent = points.parent[slot];
  look_at_children(parent);
  for (const std::int32_t neighbor : centers.edges.row(parent)) look_at_children(neighbor);
}

template void Hierarchy::Impl::neighbors_of_point(const detail::OpenMetric&, std::int32_t,
                                                  std::vector<std::int32_t>&) const;
template void Hierarchy::Impl::neighbors_of_point(const detail::OrthorhombicMetric&, std::int32_t,
                                                  std::vector<std::int32_t>&) const;
template void Hierarchy::Impl::neighbors_of_point(const detail::LatticeMetric&, std::int32_t,
                                                  std::vector<std::int32_t>&) const;

}  // namespace dch
