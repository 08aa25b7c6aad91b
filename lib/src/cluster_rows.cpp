// SPDX-License-Identifier: MIT
#include "cluster_rows.hpp"

#include <algorithm>
#include <cmath>

#include "metric.hpp"

namespace dch::detail {
namespace {

/// Parts of the work for each thread, so that none waits long for the last one.
constexpr int kPartsPerThread = 4;

void start(NeighborList& list) {
  list.kind = ListKind::half;
  list.first.assign(1, 0);
  list.particle.clear();
  list.j.resize(list.j.capacity());
}

}  // namespace

template <class Metric>
void ClusterRows::find(const Metric& metric, const Box& box, const Level& clusters, const PointBlocks& blocks,
                       Span<const std::int32_t> slot_of_id, std::int32_t first_ghost, double error,
                       const PairFilter& filter, Executor* executor, NeighborList& out) {
  start(out);
  const double reach = std::sqrt(filter.largest_distance2());
  constexpr double kInflate = 1 + 1e-12;
  // Two images of a point may both be within the band of the cutoff only if it is half a period.
  if (box.any_periodic() && (reach + 2 * error) * kInflate >= box.max_cutoff())
    return find_by_distance(metric, clusters, blocks, filter, out);
  points_.quantize(blocks, first_ghost, reach, error, executor);
  const bool one_image =
      !box.any_periodic() || (reach + 2 * points_.largest_extent) * kInflate < box.max_cutoff();
  const RowFinder::Scene<Metric> scene{metric,  box,    clusters, blocks,   slot_of_id,
                                       points_, filter, reach,    one_image};
  if (executor && executor->threads() > 1) return find_side_by_side(scene, *executor, out);
  finders_.resize(1);
  finders_[0].use(instruction_set());
  for (std::int32_t k = 0; k < clusters.size(); ++k)
    if (clusters.is_alive(k)) finders_[0].append_rows(scene, k, out);
}

/// Each part of the clusters by itself, then all pieces behind each other.
template <class Metric>
void ClusterRows::find_side_by_side(const RowFinder::Scene<Metric>& scene, Executor& executor,
                                    NeighborList& out) {
  const int parts = kPartsPerThread * executor.threads();
  finders_.resize(static_cast<std::size_t>(parts));
  pieces_.resize(static_cast<std::size_t>(parts));
  const std::int32_t clusters = scene.centers.size();
  executor.run(parts, [&](int part) {
    const auto cut = [&](int k) { return static_cast<std::int32_t>(std::int64_t{clusters} * k / parts); };
    RowFinder& finder = finders_[static_cast<std::size_t>(part)];
    NeighborList& piece = pieces_[static_cast<std::size_t>(part)];
    start(piece);
    finder.use(instruction_set());
    for (std::int32_t k = cut(part); k < cut(part + 1); ++k)
      if (scene.centers.is_alive(k)) finder.append_rows(scene, k, piece);
  });
  std::vector<std::size_t> first_row(pieces_.size() + 1, 0), first_entry(pieces_.size() + 1, 0);
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    first_row[p + 1] = first_row[p] + pieces_[p].size();
    first_entry[p + 1] = first_entry[p] + static_cast<std::size_t>(pieces_[p].first.back());
  }
  out.first.resize(first_row.back() + 1);
  out.particle.resize(first_row.back());
  if (out.j.size() < first_entry.back()) out.j.resize(first_entry.back());
  executor.run(parts, [&](int part) {
    const auto p = static_cast<std::size_t>(part);
    const NeighborList& piece = pieces_[p];
    std::copy(piece.particle.begin(), piece.particle.end(),
              out.particle.begin() + static_cast<std::ptrdiff_t>(first_row[p]));
    std::copy_n(piece.j.data(), piece.first.back(), out.j.data() + first_entry[p]);
    for (std::size_t r = 0; r < piece.size(); ++r)
      out.first[first_row[p] + r + 1] = static_cast<std::int64_t>(first_entry[p]) + piece.first[r + 1];
  });
}

/// Where lists reach half the box, with the nearest image found pair by pair.
template <class Metric>
void ClusterRows::find_by_distance(const Metric& metric, const Level& clusters, const PointBlocks& points,
                                   const PairFilter& filter, NeighborList& out) {
  std::vector<std::int32_t> own, others;
  for (std::int32_t k = 0; k < clusters.size(); ++k) {
    if (!clusters.is_alive(k)) continue;
    others.clear();
    const auto collect = [&](std::int32_t slot) { others.push_back(slot); };
    points.for_each(clusters.first_child[k], collect);
    own = others;
    for (const std::int32_t other : clusters.edges.row(k))
      if (other > k) points.for_each(clusters.first_child[other], collect);
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
    }
  }
}

std::size_t ClusterRows::memory_bytes() const {
  std::size_t bytes = points_.memory_bytes();
  for (const RowFinder& finder : finders_) bytes += finder.memory_bytes();
  for (const NeighborList& piece : pieces_)
    bytes += piece.first.capacity() * sizeof(std::int64_t) +
             (piece.particle.capacity() + piece.j.capacity()) * sizeof(std::int32_t);
  return bytes;
}

#define DCH_INSTANTIATE(Metric)                                                                      \
  template void ClusterRows::find(const Metric&, const Box&, const Level&, const PointBlocks&,       \
                                  Span<const std::int32_t>, std::int32_t, double, const PairFilter&, \
                                  Executor*, NeighborList&);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
