// SPDX-License-Identifier: MIT
#include <type_traits>

#include <dch/base/error.hpp>
#include <dch/clusters/cluster_pair_maker.hpp>

#include "base/describe.hpp"
#include "clusters/cluster_pair_finder.hpp"
#include "geometry/metric.hpp"
#include "hierarchy/structure.hpp"
#include "lists/list_check.hpp"
#include "lists/reach.hpp"

namespace dch {
namespace {

constexpr double kMinRadius = 1e-9, kMaxRadius = 1e9;  ///< squares stay far from overflow in float

}  // namespace

struct ClusterPairMaker::Impl {
  detail::ClusterPairFinder finder;
};

ClusterPairMaker::ClusterPairMaker() : impl_(std::make_unique<Impl>()) {}
ClusterPairMaker::~ClusterPairMaker() = default;
ClusterPairMaker::ClusterPairMaker(ClusterPairMaker&&) noexcept = default;
ClusterPairMaker& ClusterPairMaker::operator=(ClusterPairMaker&&) noexcept = default;

void ClusterPairMaker::make(const HierarchyView& view, const ListParams& params, ClusterPairs& out) {
  const detail::Structure& hierarchy = view.structure();
  detail::check_list_params(params, hierarchy.raw.size(), hierarchy.params.radius);
  const double radius = params.list_radius();
  if (!(radius >= kMinRadius && radius <= kMaxRadius))
    throw InvalidParameter("cutoff + skin = " + detail::describe(radius) +
                           " is outside 1e-9..1e9, where cluster pairs hold coordinates in single precision; "
                           "use another unit of length, or a neighbor list");
  const int refreshes = out.refreshes;
  try {
    const double reach = radius + detail::distance_error(hierarchy);
    detail::with_metric(hierarchy.box, [&](const auto& metric) {
      using Scene = detail::ClusterPairFinder::Scene<std::decay_t<decltype(metric)>>;
      impl_->finder.find(Scene{metric, hierarchy.box, hierarchy.levels[1], hierarchy.points, hierarchy.leaves,
                               hierarchy.raw, params, reach},
                         hierarchy.params.executor, out);
    });
    out.refresh(hierarchy.raw, hierarchy.box, hierarchy.params.executor);
    out.refreshes = 0;
    out.refreshes_before = refreshes;
  } catch (...) {
    out = ClusterPairs();
    throw;
  }
}

ClusterPairWork ClusterPairMaker::work() const { return impl_->finder.work(); }
std::size_t ClusterPairMaker::memory_bytes() const { return impl_->finder.memory_bytes(); }

}  // namespace dch
