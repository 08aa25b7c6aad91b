// SPDX-License-Identifier: MIT
#include "ClusterPairKeeper.h"

#include <utility>

#include "HostState.h"

namespace OpenMMDCH {
namespace {

// Of the cutoff: see docs/openmm.md for what it costs.
constexpr double kSkinFraction = 0.15;

}  // namespace

ClusterPairKeeper::ClusterPairKeeper(double cutoffDistance, const dch::Exclusions& exclusions,
                                     dch::Executor& executor)
    : cutoff(cutoffDistance), pool(executor) {
  request.exclusions = &exclusions;
  setTypes({}, 1);
}

void ClusterPairKeeper::setTypes(std::vector<std::int32_t> types, int typeCount) {
  particleTypes = std::move(types);
  const auto side = static_cast<std::size_t>(typeCount);
  request.types = particleTypes;
  request.cutoffs = dch::TypeCutoffs(typeCount, std::vector<double>(side * side, cutoff));
  if (staleTest) staleTest->forget();
}

bool ClusterPairKeeper::fits(const dch::Box& box) const {
  return roomForSkin(cutoff, kSkinFraction, box) >= 0;
}

/// As large as there is room, or near it, since boxes change all the time under a barostat.
void ClusterPairKeeper::chooseSkin(const dch::Box& box) {
  const double room = roomForSkin(cutoff, kSkinFraction, box);
  if (search && request.skin <= room && request.skin >= 0.5 * room) return;
  request.skin = room;
  dch::HierarchyParams params;
  params.radius = request.list_radius();
  params.executor = &pool;
  search = dch::make_dch_search(params);
  staleTest.emplace(request.skin);
}

const dch::ClusterPairs& ClusterPairKeeper::at(dch::Span<const dch::Vec3> positions, const dch::Box& box) {
  chooseSkin(box);
  if (staleTest->is_stale(positions, box)) {
    staleTest->forget();
    search->update(positions, box);
    dch::hierarchy_of(*search)->cluster_pairs(request, pairs);
    staleTest->remember(positions, box);
  } else {
    pairs.refresh(positions, box, &pool);
  }
  return pairs;
}

}  // namespace OpenMMDCH
