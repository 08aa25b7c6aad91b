// SPDX-License-Identifier: MIT
#include "ClusterPairKeeper.h"

#include <cmath>
#include <utility>

#include "HostState.h"

namespace OpenMMDCH {
namespace {

// Of the cutoff: see docs/openmm.md for what it costs.
constexpr double kSkinFraction = 0.1;
// While fewer than one particle in so many is away from its cluster, all stay where they are: to move them
// takes longer than to refresh the clusters of those few.
constexpr std::size_t kAwayOfOne = 32;

}  // namespace

ClusterPairKeeper::ClusterPairKeeper(double cutoffDistance, const dch::Exclusions& exclusions,
                                     dch::Executor& executor)
    : cutoff(cutoffDistance), pool(executor) {
  request.cutoffs = dch::TypeCutoffs(cutoff);
  request.exclusions = &exclusions;
}

void ClusterPairKeeper::setTypes(std::vector<std::int32_t> types, int count) {
  particleTypes = std::move(types);
  typeCount = count;
  labelPairs();
}

/// Which pairs there are does not depend on types: all have one cutoff.
void ClusterPairKeeper::labelPairs() {
  pairs.types = typeCount;
  for (std::size_t k = 0; k < pairs.particle.size(); ++k) {
    const bool isTyped = typeCount > 1 && pairs.particle[k] >= 0;
    pairs.type[k] = isTyped ? particleTypes[static_cast<std::size_t>(pairs.particle[k])] : 0;
  }
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
  expiry.emplace(request.skin, dch::Expiry::exact, dch::KeptImages::as_found);
}

void ClusterPairKeeper::rememberPeriods(dch::Span<const dch::Vec3> positions, const dch::Box& box) {
  periods.assign(positions.size(), {});
  shifts.clear();
  std::size_t away = 0;
  for (std::size_t k = 0; k < pairs.particle.size(); ++k) {
    if (pairs.particle[k] < 0) continue;
    const auto i = static_cast<std::size_t>(pairs.particle[k]);
    const std::size_t cluster = k / dch::ClusterPairs::kSlots, slot = k % dch::ClusterPairs::kSlots;
    const auto& at = pairs.at[cluster];
    const dch::Vec3 origin = pairs.origin[static_cast<std::size_t>(pairs.origin_of[cluster])];
    const dch::Vec3 near = origin + dch::Vec3{at.x[slot], at.y[slot], at.z[slot]};
    const dch::Vec3 n = box.fractional(near) - box.fractional(positions[i]);
    periods[i] = {std::nearbyint(n.x), std::nearbyint(n.y), std::nearbyint(n.z)};
    away += norm2(periods[i]) > 0;
  }
  if (away * kAwayOfOne < positions.size()) periods.clear();
}

dch::Span<const dch::Vec3> ClusterPairKeeper::broughtNear(dch::Span<const dch::Vec3> positions,
                                                          const dch::Box& box) {
  if (periods.size() != positions.size()) return positions;
  if (shifts.empty() || box != boxOfShifts) {
    const dch::Vec3 a = box.vector(0), b = box.vector(1), c = box.vector(2);
    shifts.clear();
    for (const dch::Vec3 n : periods) shifts.push_back(n.x * a + n.y * b + n.z * c);
    boxOfShifts = box;
    nearPositions.resize(positions.size());
  }
  for (std::size_t i = 0; i < positions.size(); ++i) nearPositions[i] = positions[i] + shifts[i];
  return nearPositions;
}

const dch::ClusterPairs& ClusterPairKeeper::at(dch::Span<const dch::Vec3> positions, const dch::Box& box,
                                               bool joins) {
  chooseSkin(box);
  const dch::Span<const dch::Vec3> near = broughtNear(positions, box);
  if (!expiry->is_stale(near, box, request, *search)) {
    pairs.refresh(near, box, &pool);
    return pairs;
  }
  expiry->forget();
  search->update(positions, box);  // checks them
  search->cluster_pairs(request, pairs);
  if (joins) pairs.join_entries(&pool);
  ++searchCount;
  labelPairs();
  if (box.any_periodic()) rememberPeriods(positions, box);
  expiry->remember(positions, box, request);
  return pairs;
}

}  // namespace OpenMMDCH
