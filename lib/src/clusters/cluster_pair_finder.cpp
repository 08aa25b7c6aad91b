// SPDX-License-Identifier: MIT
#include "clusters/cluster_pair_finder.hpp"

#include <algorithm>

#include "base/resize.hpp"
#include "geometry/lattice.hpp"
#include "geometry/metric.hpp"
#include "geometry/near_images.hpp"
#include "geometry/tolerance.hpp"
#include "leaves/leaf_frame.hpp"

namespace dch::detail {
namespace {

constexpr std::uint32_t kPairsWithinCluster = 0x08CE;  ///< bits 4 a + b with a < b
constexpr std::uint32_t kPairsOfOneSlot = 0x1111;      ///< that NearCluster has of a point alone
constexpr std::int32_t kMaxShifts = 0x10000;           ///< that the entries of a row can tell apart
/// Slices of the work for each thread, so that none waits long for the last one.
constexpr int kSlicesPerThread = 8;

/// Bit 4 a for each slot a of a set; times the bits b of another one, the bits 4 a + b of all their pairs.
std::uint32_t spread(std::uint32_t slots) {
  return (slots & 1) | (slots & 2) << 3 | (slots & 4) << 6 | (slots & 8) << 9;
}

ClusterMove move_by(Vec3 units, std::int32_t shift) {
  ClusterMove move{};
  for (int axis = 0; axis < 3; ++axis) {
    std::int16_t by[2];
    split_shift(units[axis], by);
    for (int part = 0; part < 2; ++part) std::fill_n(move.part[part] + kSlots * axis, kSlots, by[part]);
  }
  move.part[0][15] = static_cast<std::int16_t>(static_cast<std::uint16_t>(shift % kMaxShifts));
  return move;
}

/// A box in the frame that a move leads from.
ClusterBox moved_back(const ClusterBox& box, const ClusterMove& move) {
  ClusterBox back{};
  for (int side = 0; side < 6; ++side) {
    const int first = kSlots * (side % 3), by = move.part[0][first] + move.part[1][first];
    back.side[side] = static_cast<std::int16_t>(std::clamp(box.side[side] - by, -0x8000, 0x7FFF));
  }
  return back;
}

}  // namespace

void ClusterPairFinder::Near::make_room(std::size_t count) {
  if (cluster_.size() >= count) return;
  count += count / 8;
  for (auto& side : side_) side.resize(count + kBoxesAtOnce);
  cluster_.resize(count);
}

NearClusters ClusterPairFinder::Near::from(std::int32_t k) const {
  NearClusters clusters{cluster_.data() + k, {}};
  for (std::size_t s = 0; s < side_.size(); ++s) clusters.side[s] = side_[s].data() + k;
  return clusters;
}

NearClustersTo ClusterPairFinder::Near::to(std::int32_t k) {
  NearClustersTo clusters{cluster_.data() + k, {}};
  for (std::size_t s = 0; s < side_.size(); ++s) clusters.side[s] = side_[s].data() + k;
  return clusters;
}

RowCluster ClusterPairFinder::Near::row(std::int32_t k) const {
  const auto at = static_cast<std::size_t>(k);
  RowCluster row{cluster_[at], {}};
  for (std::size_t s = 0; s < side_.size(); ++s) row.box.side[s] = side_[s][at];
  return row;
}

void ClusterPairFinder::Near::set(std::int32_t k, const NearCluster& cluster, const ClusterBox& box) {
  const auto at = static_cast<std::size_t>(k);
  cluster_[at] = cluster;
  for (std::size_t s = 0; s < side_.size(); ++s) side_[s][at] = box.side[s];
}

std::size_t ClusterPairFinder::Near::memory_bytes() const {
  std::size_t bytes = cluster_.capacity() * sizeof(cluster_[0]);
  for (const auto& side : side_) bytes += side.capacity() * sizeof(side[0]);
  return bytes;
}

std::int32_t ClusterPairFinder::shift_count(std::size_t shifts) const {
  return index_count(static_cast<std::int64_t>(shifts), "pairs of nodes near each other",
                     "take a smaller cutoff or fewer points", limits.shifts);
}

template <class Metric>
void ClusterPairFinder::find(const Scene<Metric>& scene, Executor* executor, ClusterPairs& out) {
  kernels_ = &cluster_search_kernels(instruction_set());
  // Coordinates, and differences of them, that saturate leave a gap of half the range less half the width of
  // a node to all points of that: more than the reach.
  unit_ = frame_unit(scene.box, 0.5 * scene.leaves.largest_width + scene.reach);
  one_image_ = (scene.reach + 2 * scene.leaves.largest_extent) * kInflate < scene.box.max_cutoff();
  ShiftError shift_error(scene.box, unit_, one_image_);
  shift_error.add(scene.nodes.position);
  limit_ = limit_of_reach(scene.reach, unit_, shift_error.largest());
  cut_into_clusters(scene, executor, out);
  images_ = Lattice(scene.box);
  drops_types_ = false;
  for (int a = 0; scene.request.radii.empty() && a < scene.request.cutoffs.types(); ++a)
    for (int b = 0; b < scene.request.cutoffs.types(); ++b)
      drops_types_ = drops_types_ || scene.request.cutoffs(a, b) == 0;

  const int slices = executor && executor->threads() > 1 ? kSlicesPerThread * executor->threads() : 1;
  slices_.resize(static_cast<std::size_t>(slices));
  if (slices == 1) swap_found(slices_[0], out);
  const auto search = [&](int p) {
    Slice& slice = slices_[static_cast<std::size_t>(p)];
    slice.rows.clear();
    slice.written = 0;
    slice.shift.clear();
    slice.work = {};
    slice.excluded.assign(scene.request.exclusions ? static_cast<std::size_t>(out.clusters()) : 0, 0);
    const std::int32_t first = share_begin(scene.nodes.size(), p, slices),
                       last = share_begin(scene.nodes.size(), p + 1, slices);
    for (std::int32_t k = first; k < last; ++k) {
      slice.progress = {k - first, last - first};
      if (scene.nodes.is_alive(k)) find_around(scene, k, out, slice);
    }
  };
  if (slices == 1) {
    search(0);
  } else {
    executor->run(slices, search);
  }
  join(executor, out);
  keep_cuts();
}

/// Each pair of nodes once: in the turn of the one that comes first. A node meets itself once, and in each of
/// half of its images.
template <class Metric>
void ClusterPairFinder::find_around(const Scene<Metric>& scene, std::int32_t k, const ClusterPairs& clusters,
                                    Slice& slice) {
  const std::vector<Vec3>& center = scene.nodes.position;
  const auto limit_for = [&](std::int32_t other) {
    const auto& leaves = scene.leaves.leaves;
    return (scene.reach + leaves[static_cast<std::size_t>(k)].extent +
            leaves[static_cast<std::size_t>(other)].extent) *
           kInflate;
  };
  slice.section.assign(2, 0);
  const auto first_shift = static_cast<std::int32_t>(slice.shift.size());
  const auto add = [&](std::int32_t other, Vec3 between) {
    collect(scene, {k, other, between, first_shift}, slice);
  };
  add(k, Vec3{});
  const auto add_near_images = [&](std::int32_t other) {
    const Vec3 nearest = scene.metric.displacement(center[k], center[other]);
    if (!one_image_)
      return for_each_near_image(scene.box, nearest, limit_for(other), other == k,
                                 [&](Vec3 between) { add(other, between); });
    if (other != k && norm2(nearest) <= limit_for(other) * limit_for(other)) add(other, nearest);
  };
  add_near_images(k);
  for (const std::int32_t other : scene.nodes.edges.row(k))
    if (other > k) add_near_images(other);
  for (std::int32_t own = 0; own < nodes_[static_cast<std::size_t>(k)].clusters; ++own)
    append_rows(own, first_shift, scene.request, clusters, slice);
}

/// Those clusters of another node (or of this one) that are near this node's box, moved to its frame.
template <class Metric>
void ClusterPairFinder::collect(const Scene<Metric>& scene, const NodePair& pair, Slice& slice) {
  const Node& own = nodes_[static_cast<std::size_t>(pair.from)];
  const Node& other = nodes_[static_cast<std::size_t>(pair.to)];
  const std::int32_t shift = static_cast<std::int32_t>(slice.shift.size()) - pair.first_shift;
  const ClusterMove move = move_by((1 / unit_) * (pair.between + (other.origin - own.origin)), shift);
  const std::int32_t already = slice.section.back();
  slice.near.make_room(static_cast<std::size_t>(already) + static_cast<std::size_t>(other.clusters));
  const std::int32_t found =
      kernels_->keep_near(clusters_.from(other.first), other.clusters, moved_back(own.box, move), limit_.out,
                          move, slice.near.to(already));
  slice.work.beside_nodes += other.clusters;
  if (found == 0) return;
  const std::vector<Vec3>& center = scene.nodes.position;
  const Vec3 straight =
      center[static_cast<std::size_t>(pair.to)] - center[static_cast<std::size_t>(pair.from)];
  slice.shift.push_back({pair.from, pair.to, images_.integers(pair.between - straight)});
  shift_count(slice.shift.size());
  if (shift > 0 && shift % kMaxShifts == 0) slice.section.push_back(already);
  slice.section.back() = already + found;
}

/// The own clusters of the node are the first of those near it, so each meets itself and what comes after.
/// One row, or more where entries cannot name all shifts.
void ClusterPairFinder::append_rows(std::int32_t own, std::int32_t first_shift, const ListParams& request,
                                    const ClusterPairs& clusters, Slice& slice) const {
  const RowCluster row = slice.near.row(own);
  const std::int32_t c = row.cluster.entry.cluster;
  const bool is_alone = row.cluster.entry.mask == kPairsOfOneSlot;
  const bool excludes = request.exclusions != nullptr && !request.exclusions->empty();
  const bool restricts = excludes || drops_types_ || ghost_[static_cast<std::size_t>(c)] != 0;
  if (excludes) mark_exclusions(*request.exclusions, c, clusters, slice);
  for (std::size_t s = 0; s + 1 < slice.section.size(); ++s, first_shift += kMaxShifts) {
    const std::int32_t first = s == 0 ? own + static_cast<std::int32_t>(is_alone) : slice.section[s];
    const std::int32_t count = slice.section[s + 1] - first;
    const std::size_t room = slice.written + static_cast<std::size_t>(count) + kEntriesAtOnce;
    make_room_for(slice.entries, room, slice.written, slice.progress);
    ClusterPairs::Entry* const entries = slice.entries.data() + slice.written;
    const FoundRow found = kernels_->find_row(row, slice.near.from(first), count, limit_.out, entries);
    slice.work.beside_clusters += count;
    slice.work.by_points += found.compared;
    if (s == 0 && !is_alone) entries->mask &= kPairsWithinCluster;
    const bool loses_own = found.entries > 0 && entries->mask == 0;
    const std::int32_t kept = restricts || loses_own
                                  ? restrict_row(c, request, clusters, entries, found.entries, slice)
                                  : found.entries;
    if (kept == 0) continue;
    slice.rows.push_back({static_cast<std::int64_t>(slice.written), c, first_shift});
    slice.written += static_cast<std::size_t>(kept);
  }
  if (excludes) unmark_exclusions(*request.exclusions, c, clusters, slice);
}

/// Takes what exclusions, ghosts and types forbid out of the masks of a row of cluster c. Returns how many
/// entries are left.
std::int32_t ClusterPairFinder::restrict_row(std::int32_t c, const ListParams& request,
                                             const ClusterPairs& clusters, ClusterPairs::Entry* row,
                                             std::int32_t found, Slice& slice) const {
  slice.work.by_slots += found;
  const std::uint32_t ghosts = spread(ghost_[static_cast<std::size_t>(c)]);
  std::int32_t kept = 0;
  for (std::int32_t n = 0; n < found; ++n) {
    const auto other = static_cast<std::size_t>(row[n].cluster);
    std::uint32_t mask = row[n].mask & ~(ghosts * ghost_[other]);
    if (!slice.excluded.empty()) mask &= ~std::uint32_t{slice.excluded[other]};
    if (drops_types_) mask &= pairs_of_wanted_types(request.cutoffs, c, row[n].cluster, clusters);
    row[kept] = row[n];
    row[kept].mask = static_cast<std::uint16_t>(mask);
    kept += mask != 0;
  }
  return kept;
}

#define DCH_INSTANTIATE(Metric) \
  template void ClusterPairFinder::find(const Scene<Metric>&, Executor*, ClusterPairs&);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
