// SPDX-License-Identifier: MIT
//
// ClusterPairFinder: the points of each node, cut into clusters of four.
#include <algorithm>
#include <utility>

#include "clusters/cluster_pair_finder.hpp"
#include "geometry/binary_grid.hpp"
#include "geometry/metric.hpp"
#include "leaves/block_offsets.hpp"
#include "leaves/leaf_frame.hpp"
#include "leaves/rounding.hpp"

namespace dch::detail {
namespace {

/// Searches that the order of a node's points is good for. In a Lennard-Jones melt with a search every ten
/// steps it takes a quarter of a search, and kept for eight adds 1 in 100 to the pairs of slots.
constexpr std::int32_t kSearchesPerOrder = 8;

constexpr std::int32_t kBlocksAhead = 8;  ///< whose positions are asked for before their turn

constexpr std::uint32_t kWithAnySlot = 0x1111;  ///< bits 4 a of the pairs of a slot with the slots a

/// A coordinate of the four slots.
struct OneAxis {
  float length[kSlots];  ///< relative to the center of the node

  /// To units, and puts the least and the largest one into the box.
  void round(float origin, float per_unit, std::int16_t* units, std::int16_t& low, std::int16_t& high) const {
    for (int slot = 0; slot < kSlots; ++slot) units[slot] = rounded((length[slot] - origin) * per_unit);
    low = std::min(std::min(units[0], units[1]), std::min(units[2], units[3]));
    high = std::max(std::max(units[0], units[1]), std::max(units[2], units[3]));
  }
};

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
    const MeasuredLeaves::Leaf& leaf = scene.leaves.leaves[static_cast<std::size_t>(k)];
    std::int32_t points = 0;
    for (std::int32_t b = leaf.first_block; b < leaf.first_block + leaf.blocks; ++b)
      points += scene.leaves.count[static_cast<std::size_t>(b)];
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
  out.entry_order = ClusterPairs::EntryOrder::as_found;
  out.parts.clear();
  out.farthest = 2 * scene.leaves.largest_extent + out.list_radius;
  out.particle.resize(all * kSlots);
  out.type.resize(all * kSlots);
  out.origin_of.resize(all);
  out.at.resize(all);
  out.at_in_units.resize(all);
  // Positions relative to origins with few digits, and differences of those, hardly ever round.
  const BinaryGrid grid(out.list_radius);
  out.origin = scene.nodes.position;
  for (Vec3& origin : out.origin) origin = {grid(origin.x), grid(origin.y), grid(origin.z)};
  clusters_.make_room(all);
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
  const MeasuredLeaves& leaves = scene.leaves;
  const MeasuredLeaves::Leaf& leaf = leaves.leaves[static_cast<std::size_t>(k)];
  local.clear();
  const BlockOffsets<Metric> anew(scene.metric, scene.positions, scene.points);
  for (std::int32_t b = leaf.first_block; b < leaf.first_block + leaf.blocks; ++b) {
    const auto block = static_cast<std::size_t>(b);
    const std::int32_t source = leaves.source[block];
    MeasuredLeaves::Offsets found{};
    if (!scene.points.keeps_positions) {
      if (b + kBlocksAhead < leaves.blocks) anew.ask_for(leaves.source[block + kBlocksAhead]);
      anew.find(source, scene.nodes.position[static_cast<std::size_t>(k)], found);
    }
    const auto& at = (scene.points.keeps_positions ? leaves.offsets[block] : found).axis;
    const std::int32_t* const id = scene.points.id.data() + std::ptrdiff_t{source} * kBlock;
    for (int lane = 0; lane < leaves.count[block]; ++lane) {
      ids[local.size()] = id[lane];
      local.push_back({{at[0][lane], at[1][lane], at[2][lane]}, static_cast<std::int32_t>(local.size())});
    }
  }
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
  node.origin = frame_origin(scene.nodes.position[static_cast<std::size_t>(k)], leaf.middle, unit_);
  const Frame frame{{static_cast<float>(node.origin.x), static_cast<float>(node.origin.y),
                     static_cast<float>(node.origin.z)},
                    static_cast<float>(1 / unit_)};
  for (std::int32_t n = 0; n < node.clusters; ++n) {
    const std::int32_t c = node.first + n;
    out.origin_of[static_cast<std::size_t>(c)] = k;
    put_cluster(ordered.data() + std::ptrdiff_t{n} * kSlots, ids, std::min(kSlots, count - n * kSlots), c,
                frame, scene.request, out);
    const ClusterBox box = clusters_.row(c).box;
    for (int axis = 0; axis < 3; ++axis) {
      std::int16_t &low = node.box.side[axis], &high = node.box.side[axis + 3];
      low = n == 0 ? box.side[axis] : std::min(low, box.side[axis]);
      high = n == 0 ? box.side[axis + 3] : std::max(high, box.side[axis + 3]);
    }
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
                                    std::int32_t c, const Frame& frame, const ListParams& request,
                                    ClusterPairs& out) {
  const auto cluster = static_cast<std::size_t>(c);
  ClusterOfFour<double>& at = out.at[cluster];
  OneAxis x{}, y{}, z{};
  std::uint32_t ghosts = 0;
  for (int slot = 0; slot < kSlots; ++slot) {
    const LocalPoint& point = points[slot < count ? slot : 0];
    x.length[slot] = point.at[0];
    y.length[slot] = point.at[1];
    z.length[slot] = point.at[2];
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
  NearCluster in_units{};
  ClusterBox box{};
  x.round(frame.origin[0], frame.per_unit, in_units.x, box.side[0], box.side[3]);
  y.round(frame.origin[1], frame.per_unit, in_units.y, box.side[1], box.side[4]);
  z.round(frame.origin[2], frame.per_unit, in_units.z, box.side[2], box.side[5]);
  in_units.entry = {c, static_cast<std::uint16_t>(kWithAnySlot * ((1u << count) - 1)), 0};
  clusters_.set(c, in_units, box);
  ghost_[cluster] = static_cast<std::uint8_t>(ghosts);
}

#define DCH_INSTANTIATE(Metric) \
  template void ClusterPairFinder::cut_into_clusters(const Scene<Metric>&, Executor*, ClusterPairs&);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
