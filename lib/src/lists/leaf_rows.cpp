// SPDX-License-Identifier: MIT
#include "lists/leaf_rows.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/metric.hpp"
#include "geometry/tolerance.hpp"
#include "leaves/rounding.hpp"

namespace dch::detail {
namespace {

/// Boxes are rounded outward by more than their centers and shifts are off; three squares are rounded too.
std::int16_t box_limit(double reach, const ListUnits& units) {
  const double box_reach = reach / units.box;
  return static_cast<std::int16_t>(std::min(std::floor(box_reach * box_reach / 0x1p15 + 1.5) + 1, 32767.0));
}

/// How far apart boxes may be that collect() takes for near [length]: it stays below the limit by 1 at least,
/// three squares are rounded, and so are centers, half widths and a shift.
double farthest_collected(double reach, const ListUnits& units) {
  constexpr double kRoundings = 8;
  return (std::sqrt((box_limit(reach, units) + 1.5) * 0x1p15) + kRoundings) * units.box;
}

/// The finest units in which the rows of source `s` can be found. Coordinates and their differences are
/// integers modulo 2^16 = P, and no more than these has to hold of the points in them:
/// - Boxes of blocks are taken relative to each other, so a leaf is narrower than P / 2.
/// - A filter takes points relative to the middle of a box. With a half width h of the box and a reach r, a
///   difference d is mistaken for a near one only if |d| > P - h - r. The box of a part of a leaf is at most
///   as wide as the leaf, w, and meets points of blocks that collect() has found: |d| <= w / 2 + c + b, with
///   the distance c of the blocks and their width b. So w + r + c + b < P serves, and serves the boxes within
///   that box too, which meet what it has kept: |d| + h <= w + r.
/// - A test takes points relative to one in a block whose box has kept them: |d| <= b + r < P / 2.
/// Filters and tests let points pass that are farther than r by what they round, less than 500 units.
ListUnits units_for(const ListScene& scene, std::size_t s) {
  constexpr double kPeriod = 0x1p16, kRoom = 1000;
  const MeasuredLeaves& own = scene.sources[s]->measured();
  double farthest = 0;
  for (std::size_t a = 0; a <= s; ++a)
    farthest = std::max(farthest, scene.reach_of(s, a) +
                                      3 * (own.largest_extent + scene.sources[a]->measured().largest_extent));
  ListUnits units{0, finest_unit(farthest)};
  for (std::size_t a = 0; a <= s; ++a) {
    const MeasuredLeaves& other = scene.sources[a]->measured();
    const double reach = scene.reach_of(s, a) + 2 * scene.error;  // limits are wider by that
    const double filtered =
        own.largest_width + reach + farthest_collected(reach, units) + other.largest_block_width;
    const double tested = std::max(own.largest_width, own.largest_block_width + reach);
    units.point = std::max({units.point, filtered / (kPeriod - kRoom), tested / (kPeriod / 2 - kRoom)});
  }
  units.point *= 1 + 1e-9;
  return units;
}

}  // namespace

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
    LeafScene<Metric> rows{metric, scene.box, {}, {}};
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
void LeafRows::find_rows(const LeafScene<Metric>& scene, Executor* executor,
                         const std::vector<NeighborList*>& out) {
  const Level& centers = scene.rows().centers();
  parts_.find(executor, out,
              [&](LeafCandidates& near, RowFinder& finder, NeighborList* lists, int share, int shares) {
                const std::int32_t last = share_begin(centers.size(), share + 1, shares);
                for (std::int32_t k = share_begin(centers.size(), share, shares); k < last; ++k) {
                  if (!centers.is_alive(k)) continue;
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

}  // namespace dch::detail
