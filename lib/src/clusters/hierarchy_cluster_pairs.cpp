// SPDX-License-Identifier: MIT
//
// Pairs for SIMD force kernels: the level-0 edges again, cluster by cluster of four.
#include <chrono>
#include <type_traits>

#include <dch/base/error.hpp>

#include "base/describe.hpp"
#include "hierarchy/structure.hpp"
#include "geometry/position_check.hpp"
#include "lists/list_check.hpp"

namespace dch {
namespace {

constexpr double kLeastRadius = 1e-9, kLargestRadius = 1e9;  ///< squares stay far from overflow in float

}  // namespace

void Hierarchy::Impl::cluster_pairs(const ListParams& request, ClusterPairs& out) {
  const auto start = std::chrono::steady_clock::now();
  detail::check_list_params(request, raw.size(), params.radius);
  const double radius = request.list_radius();
  if (!(radius >= kLeastRadius && radius <= kLargestRadius))
    throw InvalidParameter("cutoff + skin = " + detail::describe(radius) +
                           " is outside 1e-9..1e9, where cluster pairs hold coordinates in single precision; "
                           "use another unit of length, or a neighbor list");
  try {
    const double reach = radius + prepare_for_lists();
    detail::with_metric(box, [&](const auto& metric) {
      using Scene = detail::ClusterPairFinder::Scene<std::decay_t<decltype(metric)>>;
      pair_finder.find(Scene{metric, box, levels[1], points, raw, request, reach}, params.executor, out);
    });
    out.refresh(raw, box);
  } catch (...) {
    out = ClusterPairs();
    throw;
  }
  stats.list_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Hierarchy::cluster_pairs(const ListParams& params, ClusterPairs& out) {
  impl_->cluster_pairs(params, out);
}

}  // namespace dch
