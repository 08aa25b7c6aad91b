// SPDX-License-Identifier: MIT
#include "clusters/cluster_pair_finder.hpp"

#include <algorithm>

#include "geometry/lattice.hpp"
#include "geometry/metric.hpp"
#include "geometry/near_images.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

constexpr std::uint32_t kPairsWithinCluster = 0x08CE;  ///< bits 4 a + b with a < b
constexpr std::int32_t kMaxShifts = 0x10000;           ///< that the entries of a row can tell apart
/// Slices of the work for each thread, so that none waits long for the last one.
constexpr int kSlicesPerThread = 4;
constexpr double kFloatRounding = 0x1p-24;
/// Bit 4 a for each slot a of a set; times the bits b of another one, the bits 4 a + b of all their pairs.
std::uint32_t spread(std::uint32_t slots) {
  return (slots & 1) | (slots & 2) << 3 | (slots & 4) << 6 | (slots & 8) << 9;
}

}  // namespace

void ClusterPairFinder::Boxes::make_room(std::size_t count) {
  for (auto& coordinates : side) coordinates.resize(std::max(coordinates.size(), count));
}

BoxArrays ClusterPairFinder::Boxes::from(std::int32_t k) const {
  BoxArrays arrays{};
  for (std::size_t s = 0; s < side.size(); ++s) arrays.side[s] = side[s].data() + k;
  return arrays;
}

std::int32_t ClusterPairFinder::shift_count(std::size_t shifts) const {
  return index_count(static_cast<std::int64_t>(shifts), "pairs of nodes near each other",
                     "take a smaller cutoff or fewer points", limits.shifts);
}

template <class Metric>
void ClusterPairFinder::find(const Scene<Metric>& scene, Executor* executor, ClusterPairs& out) {
  kernels_ = &cluster_search_kernels(instruction_set());
  cut_into_clusters(scene, executor, out);
  double largest_extent = 0;
  for (const Node& node : nodes_) largest_extent = std::max(largest_extent, node.extent);
  // With extents e and the reach r, two points, the vector between their nodes and its sum with one of them
  // are up to e, e, r + 2 e and r + e long when each is rounded to single precision; their difference, its
  // square and the limit round by up to 3 r more.
  const double reach = scene.reach + 6 * kFloatRounding * (scene.reach + largest_extent);
  limit2_ = static_cast<float>(reach * reach);
  images_ = Lattice(scene.box);
  one_image_ = (scene.reach + 2 * largest_extent) * kInflate < scene.box.max_cutoff();
  drops_types_ = false;
  for (int a = 0; scene.request.radii.empty() && a < scene.request.cutoffs.types(); ++a)
    for (int b = 0; b < scene.request.cutoffs.types(); ++b)
      drops_types_ = drops_types_ || scene.request.cutoffs(a, b) == 0;

  const int slices = executor && executor->threads() > 1 ? kSlicesPerThread * executor->threads() : 1;
  slices_.resize(static_cast<std::size_t>(slices));
  const std::int32_t nodes = scene.nodes.size();
  const auto search = [&](int p) {
    Slice& slice = slices_[static_cast<std::size_t>(p)];
    slice.rows.clear();
    slice.entries.clear();
    slice.shift.clear();
    slice.work = {};
    slice.excluded.assign(scene.request.exclusions ? static_cast<std::size_t>(out.clusters()) : 0, 0);
    for (std::int32_t k = share_begin(nodes, p, slices); k < share_begin(nodes, p + 1, slices); ++k)
      if (scene.nodes.is_alive(k)) find_around(scene, k, out, slice);
  };
  if (slices == 1) {
    search(0);
  } else {
    executor->run(slices, search);
  }
  join(out);
  std::swap(cuts_, last_cuts_);
}

/// Each pair of nodes once: in the turn of the one that comes first. A node meets itself once, and in each of
/// half of its images.
template <class Metric>
void ClusterPairFinder::find_around(const Scene<Metric>& scene, std::int32_t k, const ClusterPairs& clusters,
                                    Slice& slice) {
  const std::vector<Vec3>& center = scene.nodes.position;
  const auto limit_for = [&](std::int32_t other) {
    return (scene.reach + extent(k) + extent(other)) * kInflate;
  };
  slice.near.clear();
  slice.source.clear();
  const auto first_shift = static_cast<std::int32_t>(slice.shift.size());
  collect(k, k, Vec3{}, Vec3{}, clusters, slice);
  const auto add = [&](std::int32_t other, Vec3 between) {
    collect(k, other, between, images_.integers(between - (center[other] - center[k])), clusters, slice);
  };
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
    append_row(k, own, first_shift, scene.request, clusters, slice);
}

/// Those clusters of another node (or of this one) that are near this node's box, moved to its frame.
void ClusterPairFinder::collect(std::int32_t k, std::int32_t other, Vec3 between, Vec3 image,
                                const ClusterPairs& clusters, Slice& slice) {
  const Node& own = nodes_[static_cast<std::size_t>(k)];
  const Node& node = nodes_[static_cast<std::size_t>(other)];
  const float by[3] = {static_cast<float>(between.x), static_cast<float>(between.y),
                       static_cast<float>(between.z)};
  Corners box{};
  for (std::size_t s = 0; s < 6; ++s) box[s] = own.box[s] - by[s % 3];
  slice.chosen.resize(std::max(slice.chosen.size(), static_cast<std::size_t>(node.clusters + kBoxesAtOnce)));
  const std::int32_t found =
      kernels_->near_boxes(boxes_.from(node.first), node.clusters, box.data(), limit2_, slice.chosen.data());
  slice.work.beside_nodes += node.clusters;
  if (found == 0) return;
  slice.shift.push_back({k, other, image});
  const std::int32_t shift = shift_count(slice.shift.size()) - 1;
  slice.boxes.make_room(slice.near.size() + static_cast<std::size_t>(found) + kBoxesAtOnce);
  for (std::int32_t n = 0; n < found; ++n) {
    const std::int32_t c = node.first + slice.chosen[static_cast<std::size_t>(n)];
    const auto cluster = static_cast<std::size_t>(c);
    ClusterOfFour<float> moved = clusters.at_float[cluster];
    for (int slot = 0; slot < kSlots; ++slot) {
      moved.x[slot] += by[0];
      moved.y[slot] += by[1];
      moved.z[slot] += by[2];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      slice.boxes.side[axis][slice.near.size()] = boxes_.side[axis][cluster] + by[axis];
      slice.boxes.side[axis + 3][slice.near.size()] = boxes_.side[axis + 3][cluster] + by[axis];
    }
    slice.near.push_back(moved);
    slice.source.push_back({c, shift, filled_[cluster], ghost_[cluster]});
  }
}

/// The own clusters of the node are the first of those near it, so each meets itself and what comes after.
void ClusterPairFinder::append_row(std::int32_t k, std::int32_t own, std::int32_t first_shift,
                                   const ListParams& request, const ClusterPairs& clusters, Slice& slice) {
  const std::int32_t c = nodes_[static_cast<std::size_t>(k)].first + own;
  const auto count = static_cast<std::int32_t>(slice.near.size()) - own;
  slice.chosen.resize(std::max(slice.chosen.size(), static_cast<std::size_t>(count + kBoxesAtOnce)));
  std::int32_t* const chosen = slice.chosen.data();
  const Corners box = slice.boxes.at(static_cast<std::size_t>(own));
  std::int32_t found = kernels_->near_boxes(slice.boxes.from(own), count, box.data(), limit2_, chosen);
  slice.work.beside_clusters += count;
  slice.work.by_points += found;
  found = kernels_->near_clusters(slice.near.data() + own, slice.near[static_cast<std::size_t>(own)], limit2_,
                                  chosen, found);
  const bool excludes = request.exclusions != nullptr && !request.exclusions->empty();
  const bool any_shift = slice.source.back().shift - first_shift < kMaxShifts;
  if (!excludes && !drops_types_ && ghost_[static_cast<std::size_t>(c)] == 0 && any_shift)
    return append_whole_row(c, own, first_shift, found, slice);
  slice.work.by_slots += found;
  if (excludes) mark_exclusions(*request.exclusions, c, clusters, slice);
  const std::uint32_t filled = spread(filled_[static_cast<std::size_t>(c)]);
  const std::uint32_t ghosts = spread(ghost_[static_cast<std::size_t>(c)]);
  const std::size_t before = slice.entries.size();
  slice.entries.resize(before + static_cast<std::size_t>(found));
  ClusterPairs::Entry* const first = slice.entries.data();
  ClusterPairs::Entry* to = first + before;
  bool has_row = false;
  for (std::int32_t n = 0; n < found; ++n) {
    const auto [other, shift, filled_there, ghosts_there] =
        slice.source[static_cast<std::size_t>(own) + static_cast<std::size_t>(chosen[n])];
    std::uint32_t mask = filled * filled_there & ~(ghosts * ghosts_there);
    if (chosen[n] == 0) mask &= kPairsWithinCluster;
    if (excludes) mask &= ~std::uint32_t{slice.excluded[static_cast<std::size_t>(other)]};
    if (drops_types_) mask &= pairs_of_wanted_types(request.cutoffs, c, other, clusters);
    if (mask == 0) continue;
    if (!has_row || shift - first_shift >= kMaxShifts) {
      if (has_row) first_shift = shift;
      slice.rows.push_back({to - first, c, first_shift});
      has_row = true;
    }
    *to++ = {other, static_cast<std::uint16_t>(mask), static_cast<std::uint16_t>(shift - first_shift)};
  }
  slice.entries.resize(static_cast<std::size_t>(to - slice.entries.data()));
  if (excludes) unmark_exclusions(*request.exclusions, c, clusters, slice);
}

/// The same where every slot that is no padding is wanted in every pair.
void ClusterPairFinder::append_whole_row(std::int32_t c, std::int32_t own, std::int32_t first_shift,
                                         std::int32_t found, Slice& slice) const {
  const std::uint32_t filled = spread(filled_[static_cast<std::size_t>(c)]);
  const Source* const from = slice.source.data() + own;
  const std::int32_t* chosen = slice.chosen.data();
  const std::uint32_t within = filled * filled_[static_cast<std::size_t>(c)] & kPairsWithinCluster;
  const std::int32_t skipped = within == 0;  // a point alone in its cluster, which is the first one found
  if (found == skipped) return;
  const std::size_t before = slice.entries.size();
  slice.rows.push_back({static_cast<std::int64_t>(before), c, first_shift});
  slice.entries.resize(before + static_cast<std::size_t>(found - skipped));
  ClusterPairs::Entry* const to = slice.entries.data() + before;
  for (std::int32_t n = skipped; n < found; ++n) {
    const Source& there = from[chosen[n]];
    to[n - skipped] = {there.cluster, static_cast<std::uint16_t>(filled * there.filled),
                       static_cast<std::uint16_t>(there.shift - first_shift)};
  }
  if (within != 0) to[0].mask = static_cast<std::uint16_t>(within);
}

ClusterPairFinder::Work ClusterPairFinder::work() const {
  Work work;
  for (const Slice& slice : slices_) work += slice.work;
  return work;
}

/// All slices behind each other.
void ClusterPairFinder::join(ClusterPairs& out) {
  out.rows.clear();
  out.entries.clear();
  out.shift.clear();
  if (slices_.size() == 1) {
    out.rows.swap(slices_[0].rows);
    out.entries.swap(slices_[0].entries);
    out.shift.swap(slices_[0].shift);
  } else {
    append_slices(out);
  }
  cut_into_tasks(out);
  out.rows.push_back({static_cast<std::int64_t>(out.entries.size()), 0, 0});
  out.split_clusters.clear();
  out.shift_vector.resize(out.shift.size());
  out.shift_vector_float.resize(out.shift.size());
  out.has_shift_vectors = false;
}

void ClusterPairFinder::append_slices(ClusterPairs& out) const {
  std::size_t rows = 0, entries = 0, shifts = 0;
  for (const Slice& slice : slices_) {
    rows += slice.rows.size();
    entries += slice.entries.size();
    shifts += slice.shift.size();
  }
  shift_count(shifts);
  out.rows.reserve(rows + 1);
  out.entries.reserve(entries);
  out.shift.reserve(shifts);
  for (const Slice& slice : slices_) {
    const auto first_entry = static_cast<std::int64_t>(out.entries.size());
    const auto first_shift = static_cast<std::int32_t>(out.shift.size());
    for (const ClusterPairs::Row& row : slice.rows)
      out.rows.push_back({first_entry + row.first, row.cluster, first_shift + row.first_shift});
    out.entries.insert(out.entries.end(), slice.entries.begin(), slice.entries.end());
    out.shift.insert(out.shift.end(), slice.shift.begin(), slice.shift.end());
  }
}

#define DCH_INSTANTIATE(Metric) \
  template void ClusterPairFinder::find(const Scene<Metric>&, Executor*, ClusterPairs&);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
