// SPDX-License-Identifier: MIT
#include "cluster_pair_lists.hpp"

#include <algorithm>

namespace dch::bench {

ClusterPairLists::ClusterPairLists(const Scene& scene) : radius_(scene.list_radii.back()) {
  request_.cutoffs = TypeCutoffs(radius_);
  request_.exclusions = scene.exclusions.empty() ? nullptr : &scene.exclusions;
  forget();
}

void ClusterPairLists::forget() {
  HierarchyParams params;
  params.radius = radius_;
  search_ = make_dch_search(params);
}

void ClusterPairLists::make() {
  search_->update(scene_->positions, scene_->box);
  search_->cluster_pairs(request_, pairs_);
}

PairSum ClusterPairLists::pairs_within(const Scene&) const {
  PairSum sum;
  pairs_.for_each([&](std::int32_t i, std::int32_t j, Vec3 apart) {
    if (norm2(apart) <= radius_ * radius_) sum.add(std::min(i, j), std::max(i, j));
  });
  return sum;
}

}  // namespace dch::bench
