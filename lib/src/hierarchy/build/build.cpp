// SPDX-License-Identifier: MIT
//
// Building from scratch: points are inserted along a space-filling curve (thesis 5.4.1), some dozens at a
// time. The nodes of level 1 near such a batch are looked up once, by one search of the hierarchy; each point
// takes the nearest of them that covers it, or else becomes a node itself, which goes into the levels above
// and into the batch's store. The points get their places when all are known, in their final order.
#include <algorithm>
#include <cmath>

#include "geometry/position_check.hpp"
#include "geometry/space_filling_order.hpp"
#include "hierarchy/build/base_radius.hpp"
#include "hierarchy/build/fill_leaves.hpp"

namespace dch {

using detail::kNone;
using detail::with_metric;

namespace {
constexpr std::size_t kMaxBatch = 64;
constexpr double kCurveCells = 4;  ///< cells of the curve in R_0

/// The box around points that are wrapped.
struct Extent {
  Vec3 low, high;

  Extent with(Vec3 p) const {
    return {{std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)},
            {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)}};
  }
  Vec3 center() const { return 0.5 * (low + high); }
  double half_diagonal() const { return 0.5 * std::sqrt(norm2(high - low)); }
};

/// Index of the point nearest to p and its squared distance.
struct Nearest {
  std::size_t index = 0;
  double distance2 = 0;
};
Nearest nearest_of(const std::vector<Vec3>& points, Vec3 p) {
  Nearest nearest{0, norm2(points[0] - p)};
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double d2 = norm2(points[k] - p);
    if (d2 < nearest.distance2) nearest = {k, d2};
  }
  return nearest;
}
}  // namespace

void Hierarchy::Impl::build(Span<const Vec3> positions, const Box& b) {
  const std::int64_t promotions = stats.promotions;
  reset(b);
  largest_reach = detail::check_positions(positions, b);
  detail::check_radius(params.radius, b);
  check_base_radius(b);
  const auto n = positions.size();
  set_base_radius(positions);
  set_wrap_slack();
  raw.assign(positions.begin(), positions.end());
  slot_of_id.assign(n, kNone);
  with_metric(box, [&](const auto& metric) {
    placing_later = true;
    choose_leaves(metric);
    placing_later = false;
    place_points(metric);
  });
  for (detail::Level& level : levels) level.complete = level.reach;
  ++stats.builds;
  stats.promotions = promotions;  // counts what motion brings about, not the growth of a new structure
}

/// Makes all levels but 0. Until place_points(), slot_of_id holds the points' parents.
template <class Metric>
void Hierarchy::Impl::choose_leaves(const Metric& metric) {
  const auto order = detail::space_filling_order(raw, box, base_radius / kCurveCells);
  // Within this of the batch's center, the nearest images of a point and of a node that covers it are apart
  // by their distance.
  const double most = std::min(base_radius, box.max_cutoff() / kInflate - base_radius);
  for (std::size_t first = 0; first < order.size();) {
    const Vec3 corner = metric.wrap(raw[order[first]]);
    Extent extent{corner, corner};
    std::size_t last = first + 1;
    for (; last < order.size() && last - first < kMaxBatch; ++last) {
      const Extent wider = extent.with(metric.wrap(raw[order[last]]));
      if (wider.half_diagonal() > most) break;
      extent = wider;
    }
    attach_batch(metric, {order.data() + first, last - first, extent.center(), extent.half_diagonal()});
    first = last;
  }
}

template <class Metric>
void Hierarchy::Impl::attach_batch(const Metric& metric, const Batch& batch) {
  Hint hint = batch_hint;
  if (batch.size == 1) {
    batch_hint = leaf_for(metric, metric.wrap(raw[batch.ids[0]]), batch.ids[0], hint);
    return;
  }
  find_near(metric, batch.center, 1, (base_radius + batch.extent) * kInflate, hint);
  batch_nodes.clear();
  batch_centers.clear();  // relative to the batch's
  const auto add = [&](std::int32_t node) {
    batch_nodes.push_back(node);
    batch_centers.push_back(metric.displacement(batch.center, levels[1].position[node]));
  };
  for (const Near& found : near[1]) add(found.node);
  for (const std::int32_t* id = batch.ids; id != batch.ids + batch.size; ++id) {
    const Vec3 at = metric.wrap(raw[*id]);
    if (!batch_nodes.empty()) {
      stats.distances += static_cast<std::int64_t>(batch_centers.size()) + 1;
      const Nearest nearest = nearest_of(batch_centers, at - batch.center);
      const std::int32_t node = batch_nodes[nearest.index];
      hint = {1, node};
      if (metric.distance2(at, levels[1].position[node]) <= levels[0].radius2) {
        slot_of_id[*id] = node;
        continue;
      }
    }
    hint = leaf_for(metric, at, *id, hint);
    const bool is_new =
        hint.level == 1 && std::find(batch_nodes.begin(), batch_nodes.end(), hint.node) == batch_nodes.end();
    if (is_new) add(hint.node);
  }
  batch_hint = hint;
}

/// Gives a point a parent in level 1, a new one if there was none, or makes it a singleton. Returns which.
template <class Metric>
Hierarchy::Impl::Hint Hierarchy::Impl::leaf_for(const Metric& metric, Vec3 at, std::int32_t id, Hint hint) {
  const Cover cover = locate(metric, at, 1, hint);
  const std::int32_t leaf = promote(metric, 0, id, at, cover);
  if (leaf != kNone) slot_of_id[id] = leaf;
  grow_top(metric);
  if (!is_singleton_point(id)) return {1, leaf};
  const Singleton& node = singletons[singleton_at(slot_of_id[id])];
  return {node.level, node.node};
}

template <class Metric>
void Hierarchy::Impl::place_points(const Metric& metric) {
  const std::vector<std::int32_t> order = reorder_levels();
  for (std::int32_t& leaf : slot_of_id)
    if (leaf >= 0) leaf = order[leaf];
  std::vector<std::int32_t> leaf_of = slot_of_id;
  fill_leaves(
      metric, points, leaf_of, [](std::size_t id) { return static_cast<std::int32_t>(id); },
      [&](std::size_t id) { return metric.wrap(raw[id]); });
}

#define DCH_INSTANTIATE(Metric)                                \
  template void Hierarchy::Impl::choose_leaves(const Metric&); \
  template void Hierarchy::Impl::place_points(const Metric&);
DCH_INSTANTIATE(detail::OpenMetric)
DCH_INSTANTIATE(detail::OrthorhombicMetric)
DCH_INSTANTIATE(detail::LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch
