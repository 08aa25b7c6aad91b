// SPDX-License-Identifier: MIT
#include "lists/leaf_rows.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/metric.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

/// Parts of the work for each thread, so that none waits long for the last one.
constexpr int kSlicesPerThread = 4;
constexpr double kMaxDifference =
    32700;  ///< of a difference of coordinates in units; leaves room for rounding

void start(NeighborList& list) {
  list.kind = ListKind::half;
  list.first.assign(1, 0);
  list.particle.clear();
  list.near_end.clear();
  list.j.resize(list.j.capacity());
  list.margin = 0;
}

/// The finest units in which the rows of source `s` can be found.
ListUnits units_for(const ListScene& scene, std::size_t s) {
  const MeasuredLeaves& own = scene.sources[s]->measured();
  double widest = 0, farthest = 0;
  for (std::size_t a = 0; a <= s; ++a) {
    const MeasuredLeaves& other = scene.sources[a]->measured();
    const double reach = scene.reach_of(s, a);
    // The largest difference of coordinates that is taken: between a point of a leaf and one within reach
    // of the leaf's box, or between the middle of the box and a point of a block within reach of it.
    widest = std::max(
        widest, reach + std::max(own.largest_width, 0.5 * own.largest_width + other.largest_block_width));
    farthest = std::max(farthest, reach + 3 * (own.largest_extent + other.largest_extent));
  }
  return {widest * (1 + 1e-9) / kMaxDifference, farthest * (1 + 1e-9) / kMaxDifference};
}

/// Boxes are rounded outward by more than their centers and shifts are off; three squares are rounded too.
std::int16_t box_limit(double reach, const ListUnits& units) {
  const double box_reach = reach / units.box;
  return static_cast<std::int16_t>(std::min(std::floor(box_reach * box_reach / 0x1p15 + 1.5) + 1, 32767.0));
}

}  // namespace

template <class Metric>
void LeafRows::find(const Metric& metric, const ListScene& scene,
                    const std::vector<const PairFilter*>& filters, const std::vector<NeighborList*>& out) {
  for (NeighborList* list : out) start(*list);
  // Two images of a point may both be within the band of the cutoff only if it is half a period.
  const double largest = *std::max_element(scene.reach.begin(), scene.reach.end());
  if (scene.box.any_periodic() && (largest + 2 * scene.error) * kInflate >= scene.box.max_cutoff()) {
    for (std::size_t r = 0; r < out.size(); ++r)
      find_by_distance(metric, *scene.sources[0], *filters[r], *out[r]);
    return;
  }
  const ListParams& params = filters.front()->params();
  const ParticleLabels labels{filters.front()->by(), params.radii, params.types, params.first_ghost};
  for (LeafSource* source : scene.sources)
    source->labelled.label(source->measured(), source->structure->points, source->ids, labels,
                           scene.executor);
  for (std::size_t s = 0; s < scene.sources.size(); ++s) {
    const ListUnits units = units_for(scene, s);
    RowFinder::Scene<Metric> rows{metric, scene.box, {}, {}};
    for (std::size_t turn = 0; turn <= s; ++turn) {
      const std::size_t a = turn == 0 ? s : turn - 1;  // the source of the rows first
      LeafSource& source = *scene.sources[a];
      source.quantized.quantize(source.measured(), source.labelled, units, scene.executor);
      const double reach = scene.reach_of(s, a);
      const double extents = scene.sources[s]->measured().largest_extent + source.measured().largest_extent;
      const bool one_image =
          !scene.box.any_periodic() || (reach + extents) * kInflate < scene.box.max_cutoff();
      rows.near.push_back({&source, reach, box_limit(reach, units), one_image});
    }
    double farthest = 0;
    for (const NearSource& near : rows.near) farthest = std::max(farthest, near.reach);
    for (std::size_t r = 0; r < out.size(); ++r) {
      rows.requests.push_back({filters[r], ListLimits(*filters[r], units.point, farthest, scene.error)});
      if (filters[r]->params().superset)
        out[r]->margin = std::max(out[r]->margin, rows.requests.back().limits.margin);
    }
    find_rows(rows, scene.executor, out);
  }
}

template <class Metric>
void LeafRows::find_rows(const RowFinder::Scene<Metric>& scene, Executor* executor,
                         const std::vector<NeighborList*>& out) {
  const Level& centers = scene.rows().centers();
  const auto find_slice = [&](Slice& slice, std::int32_t first, std::int32_t last) {
    slice.finder.use(instruction_set());
    for (std::int32_t k = first; k < last; ++k)
      if (centers.is_alive(k)) slice.finder.append_rows(scene, k, slice.lists.data());
  };
  if (!executor || executor->threads() == 1) {
    slices_.resize(1);
    Slice& slice = slices_.front();
    slice.lists.resize(out.size());
    for (std::size_t r = 0; r < out.size(); ++r) std::swap(slice.lists[r], *out[r]);
    find_slice(slice, 0, centers.size());
    for (std::size_t r = 0; r < out.size(); ++r) std::swap(slice.lists[r], *out[r]);
    return;
  }
  const int slices = kSlicesPerThread * executor->threads();
  slices_.resize(static_cast<std::size_t>(slices));
  executor->run(slices, [&](int p) {
    Slice& slice = slices_[static_cast<std::size_t>(p)];
    slice.lists.resize(out.size());
    for (NeighborList& list : slice.lists) start(list);
    find_slice(slice, share_begin(centers.size(), p, slices), share_begin(centers.size(), p + 1, slices));
  });
  for (std::size_t r = 0; r < out.size(); ++r) append_pieces(*executor, r, *out[r]);
}

/// Puts what the slices found behind each other.
void LeafRows::append_pieces(Executor& executor, std::size_t list, NeighborList& out) {
  std::vector<std::size_t> first_row(slices_.size() + 1, out.particle.size());
  std::vector<std::size_t> first_entry(slices_.size() + 1, static_cast<std::size_t>(out.first.back()));
  for (std::size_t p = 0; p < slices_.size(); ++p) {
    const NeighborList& piece = slices_[p].lists[list];
    first_row[p + 1] = first_row[p] + piece.size();
    first_entry[p + 1] = first_entry[p] + static_cast<std::size_t>(piece.first.back());
  }
  out.first.resize(first_row.back() + 1);
  out.particle.resize(first_row.back());
  const bool has_shell = std::any_of(slices_.begin(), slices_.end(),
                                     [&](const Slice& slice) { return !slice.lists[list].near_end.empty(); });
  out.near_end.resize(has_shell ? first_row.back() : 0);
  if (out.j.size() < first_entry.back()) out.j.resize(first_entry.back());
  executor.run(static_cast<int>(slices_.size()), [&](int slice) {
    const auto p = static_cast<std::size_t>(slice);
    const NeighborList& piece = slices_[p].lists[list];
    std::copy(piece.particle.begin(), piece.particle.end(),
              out.particle.begin() + static_cast<std::ptrdiff_t>(first_row[p]));
    std::copy_n(piece.j.data(), piece.first.back(), out.j.data() + first_entry[p]);
    for (std::size_t r = 0; r < piece.near_end.size(); ++r)
      out.near_end[first_row[p] + r] = static_cast<std::int64_t>(first_entry[p]) + piece.near_end[r];
    for (std::size_t r = 0; r < piece.size(); ++r)
      out.first[first_row[p] + r + 1] = static_cast<std::int64_t>(first_entry[p]) + piece.first[r + 1];
  });
}

/// Where lists reach half the box, with the nearest image found pair by pair.
template <class Metric>
void LeafRows::find_by_distance(const Metric& metric, const LeafSource& source, const PairFilter& filter,
                                NeighborList& out) {
  const Level& centers = source.centers();
  const LeafBlocks& points = source.structure->points;
  std::vector<std::int32_t> own, others;
  for (std::int32_t k = 0; k < centers.size(); ++k) {
    if (!centers.is_alive(k)) continue;
    others.clear();
    const auto collect = [&](std::int32_t slot) { others.push_back(slot); };
    points.for_each(centers.first_child[k], collect);
    own = others;
    for (const std::int32_t other : centers.edges.row(k))
      if (other > k) points.for_each(centers.first_child[other], collect);
    for (std::size_t a = 0; a < own.size(); ++a) {
      auto end = static_cast<std::size_t>(out.first.back());
      if (out.j.size() < end + others.size()) out.j.resize(2 * (end + others.size()));
      const std::int32_t i = points.id[own[a]];
      for (std::size_t b = a + 1; b < others.size(); ++b) {
        const std::int32_t j = points.id[others[b]];
        out.j[end] = j;
        end += filter.accept(i, j, metric.distance2(points.position[own[a]], points.position[others[b]]));
      }
      out.particle.push_back(i);
      out.first.push_back(static_cast<std::int64_t>(end));
      if (filter.params().shell > 0) out.near_end.push_back(static_cast<std::int64_t>(end));
    }
  }
}

ListWork LeafRows::work() const {
  ListWork work;
  for (const Slice& slice : slices_) work += slice.finder.work();
  return work;
}

std::size_t LeafRows::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Slice& slice : slices_) {
    bytes += slice.finder.memory_bytes();
    for (const NeighborList& piece : slice.lists)
      bytes += piece.first.capacity() * sizeof(std::int64_t) +
               piece.near_end.capacity() * sizeof(std::int64_t) +
               (piece.particle.capacity() + piece.j.capacity()) * sizeof(std::int32_t);
  }
  return bytes;
}

#define DCH_INSTANTIATE(Metric)                                                                        \
  template void LeafRows::find(const Metric&, const ListScene&, const std::vector<const PairFilter*>&, \
                               const std::vector<NeighborList*>&);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
