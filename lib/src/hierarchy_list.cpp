// SPDX-License-Identifier: MIT
//
// Neighbor lists: the level-0 edges of the conflict graph. ClusterRows finds them; here they are put into the
// order that was asked for.
#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include "hierarchy_impl.hpp"
#include "pair_filter.hpp"
#include "position_check.hpp"

namespace dch {

using detail::kNone;
using detail::with_metric;

namespace {

/// From rows that hold each pair once, in either row, rows of the same particles in the same order that hold
/// it in the rows of both (full) or of the one that is not a ghost.
void distribute_pairs(const NeighborList& found, std::size_t n, ListKind kind, std::int32_t first_ghost,
                      NeighborList& out) {
  const auto may_own = [&](std::int32_t particle) { return first_ghost < 0 || particle < first_ghost; };
  const auto for_each_entry = [&](const auto& f) {  // f(owner, other)
    for (std::size_t r = 0; r < found.particle.size(); ++r) {
      const std::int32_t i = found.particle[r];
      for (const std::int32_t j : found.row(r)) {
        if (may_own(i)) f(i, j);
        if (may_own(j) && (kind == ListKind::full || !may_own(i))) f(j, i);
      }
    }
  };
  std::vector<std::int32_t> row_of(n, kNone);
  for (std::size_t r = 0; r < found.particle.size(); ++r)
    row_of[found.particle[r]] = static_cast<std::int32_t>(r);
  out.kind = kind;
  out.particle = found.particle;
  out.first.assign(found.particle.size() + 1, 0);
  for_each_entry([&](std::int32_t owner, std::int32_t) { ++out.first[row_of[owner] + 1]; });
  for (std::size_t r = 0; r < found.particle.size(); ++r) out.first[r + 1] += out.first[r];
  if (out.j.size() < static_cast<std::size_t>(out.first.back()))
    out.j.resize(static_cast<std::size_t>(out.first.back()));
  std::vector<std::int64_t> next(out.first.begin(), out.first.end());
  for_each_entry([&](std::int32_t owner, std::int32_t other) { out.j[next[row_of[owner]]++] = other; });
}

}  // namespace

double Hierarchy::Impl::settle_wrap_error() {
  const double wrap_error = detail::WrapError(box).bound(largest_reach);
  if (wrap_error > wrap_slack) {  // points inserted since the last update lie much farther out
    set_wrap_slack();
    with_metric(box, [&](const auto& metric) { repair(metric, 0); });
  }
  const double rounding =
      32 * std::numeric_limits<double>::epsilon() * params.radius;  // of relative positions
  return wrap_error + rounding;
}

void Hierarchy::Impl::list(const ListParams& request, NeighborList& out) {
  const auto start = std::chrono::steady_clock::now();
  detail::check_list_params(request, raw.size(), params.radius);
  const double error = settle_wrap_error();
  const detail::PairFilter filter(raw, box, request, error);
  const bool as_found =
      request.order == RowOrder::by_structure && request.kind == ListKind::half && request.first_ghost < 0;
  NeighborList& found = as_found ? out : rows;
  with_metric(box, [&](const auto& metric) {
    measure(metric);
    cluster_rows.find(metric, box, levels[1], points, slot_of_id, request.first_ghost, error, filter,
                      params.executor, found);
  });
  if (request.order == RowOrder::by_index) {
    const auto for_each_pair = [&](const auto& f) {
      for (std::size_t r = 0; r < found.particle.size(); ++r) {
        const std::int32_t i = found.particle[r];
        for (const std::int32_t j : found.row(r)) f(std::min(i, j), std::max(i, j));
      }
    };
    assembler.assemble(raw.size(), request.kind, request.first_ghost, for_each_pair, out);
    out.particle.clear();
  } else if (!as_found) {
    distribute_pairs(found, raw.size(), request.kind, request.first_ghost, out);
  }
  stats.list_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Metric>
void Hierarchy::Impl::neighbors(const Metric& metric, int i, std::int32_t node,
                                std::vector<std::int32_t>& nodes) const {
  if (i > 0) {
    const auto stored = levels[i].edges.row(node);
    nodes.insert(nodes.end(), stored.begin(), stored.end());
    return;
  }
  const std::int32_t cluster = points.parent(node);
  const auto look_at_children = [&](std::int32_t parent) {
    for_each_child(1, parent, [&](std::int32_t other) {
      if (other != node &&
          metric.distance2(points.position[node], points.position[other]) <= levels[0].threshold2)
        nodes.push_back(other);
    });
  };
  look_at_children(cluster);
  for (const std::int32_t neighbor : levels[1].edges.row(cluster)) look_at_children(neighbor);
}

#define DCH_INSTANTIATE(Metric)                                                                          \
  template void Hierarchy::Impl::neighbors(const Metric&, int, std::int32_t, std::vector<std::int32_t>&) \
      const;
DCH_INSTANTIATE(detail::OpenMetric)
DCH_INSTANTIATE(detail::OrthorhombicMetric)
DCH_INSTANTIATE(detail::LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch
