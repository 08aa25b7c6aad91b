// SPDX-License-Identifier: MIT
#include "lists/leaf_rows.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/metric.hpp"
#include "geometry/tolerance.hpp"
#include "leaves/block_offsets.hpp"
#include "leaves/leaf_frame.hpp"
#include "leaves/rounding.hpp"

namespace dch::detail {
namespace {

/// Boxes are rounded outward by more than their centers and shifts are off; three squares are rounded too.
std::int16_t box_limit(double reach, const ListUnits& units) {
  const double box_reach = reach / units.box;
  return static_cast<std::int16_t>(std::min(std::floor(box_reach * box_reach / 0x1p15 + 1.5) + 1, 32767.0));
}

/// The finest units in which the rows of source `s` can be found. Coordinates are 16-bit integers that
/// saturate when points are shifted to the frame of another leaf, and differences are taken modulo 2^16 = P.
/// No more than these has to hold of the points in them:
/// - A leaf of which points are shifted is narrower than P.
/// - A filter takes points relative to the middle c of a box with a half width h, in the middle of its leaf:
///   |c| + h <= w / 2, with the width w of the leaf. A difference to a coordinate is at most P / 2 + |c|, so
///   if it wraps, or if the coordinate is saturated, a gap of P / 2 - |c| - h at least is left. With a reach
///   r, w / 2 + r < P / 2 serves.
/// - A test takes points relative to one in a block whose box has kept them: |d| <= b + r < P / 2, with the
///   width b of the block.
/// Filters and tests let points pass that are farther than r by what they round, less than 500 units, and the
/// middle of a leaf is rounded too.
ListUnits units_for(const ListScene& scene, std::size_t s) {
  const MeasuredLeaves& own = scene.sources[s]->measured();
  double farthest = 0, widest = 0;
  for (std::size_t a = 0; a <= s; ++a) {
    const MeasuredLeaves& other = scene.sources[a]->measured();
    farthest = std::max(farthest, scene.reach_of(s, a) + 3 * (own.largest_extent + other.largest_extent));
    const double reach = scene.reach_of(s, a) + 2 * scene.error;  // limits are wider by that
    widest = std::max({widest, 0.5 * own.largest_width + reach, own.largest_block_width + reach,
                       0.5 * other.largest_width});
  }
  return {frame_unit(scene.box, widest), finest_unit(farthest)};
}

template <class Metric>
void quantize(const Metric& metric, const ListUnits& units, Executor* executor, LeafSource& source) {
  const Structure& structure = *source.structure;
  const MeasuredLeaves& measured = source.measured();
  const std::vector<Vec3>& centers = source.centers().position;
  if (structure.points.keeps_positions)
    return source.quantized.quantize(measured, source.labelled, units, centers, executor);
  constexpr std::int32_t kAhead = 8;  // blocks whose positions are asked for before their turn
  const BlockOffsets<Metric> offsets(metric, structure.raw, structure.points);
  source.quantized.quantize(
      measured, source.labelled, units, centers, executor,
      [&](std::int32_t k, const BlockUnits& to_units, BlockPoints* points) {
        const MeasuredLeaves::Leaf& leaf = measured.leaves[k];
        for (std::int32_t b = leaf.first_block; b < leaf.first_block + leaf.blocks; ++b) {
          if (b + kAhead < measured.blocks) offsets.ask_for(measured.source[b + kAhead]);
          offsets.round(measured.source[b], measured.are_plain[b] != 0, centers[k], to_units, points[b]);
        }
      });
}

}  // namespace

// NOLINTNEXTLINE(readability-convert-member-functions-to-static): parts_ are what find_with() works on
void LeafRows::find(const ListScene& scene, const std::vector<const PairFilter*>& filters,
                    const std::vector<NeighborList*>& out) {
  with_metric(scene.box, [&](const auto& metric) { find_with(metric, scene, filters, out); });
}

template <class Metric>
void LeafRows::find_with(const Metric& metric, const ListScene& scene,
                         const std::vector<const PairFilter*>& filters,
                         const std::vector<NeighborList*>& out) {
  for (NeighborList* list : out) start_rows(*list);
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
    bool one_image = true;
    LeafScene<Metric> rows{metric, scene.box, {}, {}};
    for (std::size_t turn = 0; turn <= s; ++turn) {
      const std::size_t a = turn == 0 ? s : turn - 1;  // the source of the rows first
      LeafSource& source = *scene.sources[a];
      quantize(metric, units, scene.executor, source);
      const double reach = scene.reach_of(s, a);
      const double extents = scene.sources[s]->measured().largest_extent + source.measured().largest_extent;
      const bool has_one_image =
          !scene.box.any_periodic() || (reach + extents) * kInflate < scene.box.max_cutoff();
      rows.near.push_back({&source, reach, box_limit(reach, units), has_one_image});
      one_image = one_image && has_one_image;
    }
    double farthest = 0;
    for (const NearSource& near : rows.near) farthest = std::max(farthest, near.reach);
    ShiftError shift_error(scene.box, units.point, one_image);
    for (std::size_t a = 0; a <= s; ++a) shift_error.add(scene.sources[a]->centers().position);
    for (std::size_t r = 0; r < out.size(); ++r) {
      rows.requests.push_back(
          {filters[r], ListLimits(*filters[r], units.point, farthest, scene.error, shift_error.largest())});
      if (filters[r]->params().superset)
        out[r]->margin = std::max(out[r]->margin, rows.requests.back().limits.margin);
    }
    find_rows(rows, scene.executor, out);
  }
}

template <class Metric>
void LeafRows::find_rows(const LeafScene<Metric>& scene, Executor* executor,
                         const std::vector<NeighborList*>& out) {
  const Level& centers = scene.rows().centers();
  parts_.find(executor, out,
              [&](LeafCandidates& near, RowFinder& finder, NeighborList* lists, int share, int shares) {
                const std::int32_t first = share_begin(centers.size(), share, shares),
                                   last = share_begin(centers.size(), share + 1, shares);
                for (std::int32_t k = first; k < last; ++k) {
                  if (!centers.is_alive(k)) continue;
                  finder.note_progress(k - first, last - first);
                  near.for_each_part(scene, k,
                                     [&](const OwnBlocks& own, const Candidates& around, std::int32_t count) {
                                       finder.append_rows(scene.requests, own, around, count, lists);
                                     });
                }
              });
}

/// Where lists reach half the box, with the nearest image found pair by pair.
template <class Metric>
void LeafRows::find_by_distance(const Metric& metric, const LeafSource& source, const PairFilter& filter,
                                NeighborList& out) {
  const Level& centers = source.centers();
  const LeafBlocks& points = source.structure->points;
  std::vector<std::int32_t> own, others;  // slots
  std::vector<Vec3> at;                   // of others
  for (std::int32_t k = 0; k < centers.size(); ++k) {
    if (!centers.is_alive(k)) continue;
    others.clear();
    const auto collect = [&](std::int32_t slot) { others.push_back(slot); };
    points.for_each(centers.first_child[k], collect);
    own = others;
    for (const std::int32_t other : centers.edges.row(k))
      if (other > k) points.for_each(centers.first_child[other], collect);
    at.clear();
    for (const std::int32_t slot : others) at.push_back(source.structure->position_in(slot, metric));
    for (std::size_t a = 0; a < own.size(); ++a) {
      auto end = static_cast<std::size_t>(out.first.back());
      if (out.j.size() < end + others.size()) out.j.resize(2 * (end + others.size()));
      const std::int32_t i = points.id[own[a]];
      for (std::size_t b = a + 1; b < others.size(); ++b) {
        const std::int32_t j = points.id[others[b]];
        out.j[end] = j;
        end += filter.accept(i, j, metric.distance2(at[a], at[b]));
      }
      out.particle.push_back(i);
      out.first.push_back(static_cast<std::int64_t>(end));
      if (filter.params().shell > 0) out.near_end.push_back(static_cast<std::int64_t>(end));
    }
  }
}

}  // namespace dch::detail
