// SPDX-License-Identifier: MIT
//
// ClusterPairFinder: the points of each node, cut into clusters of four.
#include <algorithm>
#include <cmath>
#include <utility>

#include "clusters/cluster_pair_finder.hpp"
#include "geometry/binary_grid.hpp"
#include "geometry/metric.hpp"
#include "leaves/leaf_source.hpp"

namespace dch::detail {
namespace {

/// Searches that the order of a node's points is good for. In a Lennard-Jones melt with a search every ten
/// steps it takes a quarter of a search, and kept for eight adds 1 in 100 to the pairs of slots.
constexpr std::int32_t kSearchesPerOrder = 8;

}  // namespace

template <class Metric>
void ClusterPairFinder::cut_into_clusters(const Scene<Metric>& scene, Executor* executor, ClusterPairs& out) {
  nodes_.assign(static_cast<std::size_t>(scene.nodes.size()), Node());
  cuts_.of_node.assign(nodes_.size(), Cut());
  std::int32_t clusters = 0;
  for (std::int32_t k = 0; k < scene.nodes.size(); ++k) {
    Node& node = nodes_[static_cast<std::size_t>(k)];
    node.first = clusters;
    if (!scene.nodes.is_alive(k)) continue;
    std::int32_t points = 0;
    for (std::int32_t b = scene.nodes.first_child[k]; b != kNone; b = scene.points.next[b])
      points += scene.points.count[b];
    node.clusters = points / kSlots + (points % kSlots != 0);
    index_count(std::int64_t{kSlots} * clusters + std::int64_t{kSlots} * node.clusters,
                "slots of clusters of four", "take fewer points", limits.slots);
    cuts_.of_node[static_cast<std::size_t>(k)] = {clusters * kSlots, points, 0};
    clusters += node.clusters;
  }
  const auto all = static_cast<std::size_t>(clusters);
  cuts_.id.resize(all * kSlots);
  cuts_.place.resize(all * kSlots);
  out.particles = scene.positions.size();
  out.types = scene.request.radii.empty() ? scene.request.cutoffs.types() : 1;
  out.list_radius = scene.request.list_radius();
  out.box = scene.box;
  out.particle.resize(all * kSlots);
  out.type.resize(all * kSlots);
  out.origin_of.resize(all);
  out.at.resize(all);
  out.at_float.resize(all);
  // Positions relative to origins with few digits, and differences of those, hardly ever round.
  const BinaryGrid grid(out.list_radius);
  out.origin = scene.nodes.position;
  for (Vec3& origin : out.origin) origin = {grid(origin.x), grid(origin.y), grid(origin.z)};
  boxes_.make_room(all + kBoxesAtOnce);
  filled_.resize(all);
  ghost_.resize(all);
  slot_of_.assign(scene.request.exclusions ? scene.positions.size() : 0, kNone);
  for_ranges(executor, scene.nodes.size(), [&](std::int32_t first, std::int32_t last) {
    std::vector<LocalPoint> local, ordered;
    for (std::int32_t k = first; k < last; ++k)
      if (scene.nodes.is_alive(k)) cut_node(scene, k, local, ordered, out);
  });
}

template <class Metric>
void ClusterPairFinder::cut_node(const Scene<Metric>& scene, std::int32_t k, std::vector<LocalPoint>& local,
                                 std::vector<LocalPoint>& ordered, ClusterPairs& out) {
  const Cut& cut = cuts_.of_node[static_cast<std::size_t>(k)];
  std::int32_t* const ids = cuts_.id.data() + cut.first;
  std::int32_t* const place = cuts_.place.data() + cut.first;
  const Vec3 center = scene.nodes.position[static_cast<std::size_t>(k)];
  local.clear();
  double extent2 = 0;
  scene.points.for_each(scene.nodes.first_child[k], [&](std::int32_t slot) {
    const Vec3 at = scene.metric.displacement(center, scene.points.position[slot]);
    extent2 = std::max(extent2, norm2(at));
    ids[local.size()] = scene.points.id[slot];
    local.push_back(local_point(at, static_cast<std::int32_t>(local.size())));
  });
  const auto count = static_cast<std::int32_t>(local.size());
  if (order_as_before(k)) {
    ordered.clear();
    for (std::int32_t n = 0; n < count; ++n) ordered.push_back(local[static_cast<std::size_t>(place[n])]);
  } else {
    ordered.swap(local);
    order_by_fours(ordered.data(), count);
    for (std::int32_t n = 0; n < count; ++n) place[n] = ordered[static_cast<std::size_t>(n)].index;
  }
  Node& node = nodes_[static_cast<std::size_t>(k)];
  node.extent = std::sqrt(extent2);
  for (std::int32_t n = 0; n < node.clusters; ++n) {
    const std::int32_t c = node.first + n;
    out.origin_of[static_cast<std::size_t>(c)] = k;
    put_cluster(ordered.data() + std::ptrdiff_t{n} * kSlots, ids, std::min(kSlots, count - n * kSlots), c,
                scene.request, out);
    const Corners box = boxes_.at(static_cast<std::size_t>(c));
    for (std::size_t s = 0; s < 6; ++s)
      node.box[s] = n == 0 ? box[s] : s < 3 ? std::min(node.box[s], box[s]) : std::max(node.box[s], box[s]);
  }
}

/// Takes the order of the last search if the node had the same points then.
bool ClusterPairFinder::order_as_before(std::int32_t k) {
  const auto node = static_cast<std::size_t>(k);
  if (node >= last_cuts_.of_node.size()) return false;
  Cut& now = cuts_.of_node[node];
  const Cut& before = last_cuts_.of_node[node];
  if (before.points != now.points || before.age + 1 >= kSearchesPerOrder) return false;
  const std::int32_t* const ids = cuts_.id.data() + now.first;
  if (!std::equal(ids, ids + now.points, last_cuts_.id.data() + before.first)) return false;
  std::copy_n(last_cuts_.place.data() + before.first, now.points, cuts_.place.data() + now.first);
  now.age = before.age + 1;
  return true;
}

/// @param points by numbers of `ids`
void ClusterPairFinder::put_cluster(const LocalPoint* points, const std::int32_t* ids, std::int32_t count,
                                    std::int32_t c, const ListParams& request, ClusterPairs& out) {
  const auto cluster = static_cast<std::size_t>(c);
  ClusterOfFour<double>& at = out.at[cluster];
  ClusterOfFour<float>& rounded = out.at_float[cluster];
  std::uint32_t ghosts = 0;
  Corners box{};
  for (std::size_t axis = 0; axis < 3; ++axis) box[axis] = box[axis + 3] = points->at[axis];
  for (int slot = 0; slot < kSlots; ++slot) {
    const LocalPoint& point = points[slot < count ? slot : 0];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box[axis] = std::min(box[axis], point.at[axis]);
      box[axis + 3] = std::max(box[axis + 3], point.at[axis]);
    }
    rounded.x[slot] = point.at[0];
    rounded.y[slot] = point.at[1];
    rounded.z[slot] = point.at[2];
    at.x[slot] = double{point.at[0]};  // near enough for refresh() to tell the image
    at.y[slot] = double{point.at[1]};
    at.z[slot] = double{point.at[2]};
    const std::size_t k = cluster * kSlots + static_cast<std::size_t>(slot);
    const std::int32_t id = ids[point.index];
    out.particle[k] = slot < count ? id : kNone;
    out.type[k] = slot < count && out.types > 1 ? request.types[static_cast<std::size_t>(id)] : 0;
    if (slot >= count) continue;
    if (request.first_ghost >= 0 && id >= request.first_ghost) ghosts |= 1u << slot;
    if (!slot_of_.empty()) slot_of_[static_cast<std::size_t>(id)] = static_cast<std::int32_t>(k);
  }
  boxes_.set(cluster, box);
  filled_[cluster] = static_cast<std::uint8_t>((1u << count) - 1);
  ghost_[cluster] = static_cast<std::uint8_t>(ghosts);
}

#define DCH_INSTANTIATE(Metric) \
  template void ClusterPairFinder::cut_into_clusters(const Scene<Metric>&, Executor*, ClusterPairs&);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
