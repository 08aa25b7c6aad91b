// SPDX-License-Identifier: MIT
#include "ClusterPairKeeper.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "HostState.h"

namespace OpenMMDCH {
namespace {

// Of the cutoff: see docs/openmm.md for what it costs.
constexpr double kSkinFraction = 0.1;
// While fewer than one particle in so many is away from its cluster, all stay where they are: to move them
// takes longer than to refresh the clusters of those few.
constexpr std::size_t kAwayOfOne = 32;

/// Finds the periods of lattice vectors one after the other, of which most are alike.
class PeriodFinder {
 public:
  explicit PeriodFinder(const dch::Box& ofParticles)
      : box(ofParticles), near2(0.0625 * box.min_height() * box.min_height()) {}
  /// Sets what is below to a lattice vector, given up to rounding. Returns whether it is not 0.
  bool find(const dch::Vec3& about) {
    if (norm2(about) < near2) return false;
    if (norm2(about - vector) < near2) return true;
    const dch::Vec3 n = box.fractional(box.origin() + about);
    periods = {std::nearbyint(n.x), std::nearbyint(n.y), std::nearbyint(n.z)};
    vector = periods.x * box.vector(0) + periods.y * box.vector(1) + periods.z * box.vector(2);
    return true;
  }

  dch::Vec3 periods;  ///< in multiples of the box vectors
  dch::Vec3 vector;

 private:
  const dch::Box& box;
  double near2;  ///< below the squared length of any of them
};

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

void ClusterPairKeeper::rememberPlaces(dch::Span<const dch::Vec3> positions, const dch::Box& box) {
  PeriodFinder finder(box);
  periods.assign(positions.size(), {});
  shifts.clear();
  places.at = pairs.at;
  places.shift_of.assign(pairs.at.size(), -1);
  places.shift.clear();
  std::vector<bool> isAlone(positions.size(), true);
  std::size_t away = 0;
  for (std::size_t c = 0; c < pairs.at.size(); ++c) {
    const std::int32_t* const particle = &pairs.particle[dch::ClusterPairs::kSlots * c];
    const dch::Vec3 origin = pairs.origin[static_cast<std::size_t>(pairs.origin_of[c])];
    dch::ClusterOfFour<double> shift;
    bool isShifted = false;
    for (int slot = 0; slot < dch::ClusterPairs::kSlots; ++slot) {
      // Padding stands where the first particle does.
      const auto i = static_cast<std::size_t>(particle[slot] < 0 ? particle[0] : particle[slot]);
      const auto& at = pairs.at[c];
      isAlone[i] = false;
      if (!finder.find(origin + dch::Vec3{at.x[slot], at.y[slot], at.z[slot]} - positions[i])) continue;
      isShifted = true;
      shift.x[slot] = finder.vector.x;
      shift.y[slot] = finder.vector.y;
      shift.z[slot] = finder.vector.z;
      periods[i] = finder.periods;
      away += particle[slot] >= 0;
    }
    if (!isShifted) continue;
    places.shift_of[c] = static_cast<std::int32_t>(places.shift.size());
    places.shift.push_back(shift);
  }
  if (away * kAwayOfOne < positions.size()) periods.clear();
  alone.clear();
  for (std::size_t i = 0; i < isAlone.size(); ++i)
    if (isAlone[i]) alone.push_back(static_cast<std::int32_t>(i));
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

ClusterPairKeeper::Followed ClusterPairKeeper::follow(dch::Span<const dch::Vec3> positions,
                                                      const dch::Box& box) {
  const double within = expiry->allowance(positions.size(), box);
  if (within < 0 || !pairs.follow(places, positions, box, within, awayClusters, &pool))
    return Followed::Unknown;
  candidates = alone;
  for (const std::int32_t cluster : awayClusters) {
    const auto first = pairs.particle.begin() + std::ptrdiff_t{dch::ClusterPairs::kSlots} * cluster;
    std::copy_if(first, first + dch::ClusterPairs::kSlots, std::back_inserter(candidates),
                 [](std::int32_t i) { return i >= 0; });
  }
  std::sort(candidates.begin(), candidates.end());
  const bool isStale = expiry->is_stale(positions, candidates, box, request, *search);
  return isStale ? Followed::Stale : Followed::Kept;
}

bool ClusterPairKeeper::isKept(dch::Span<const dch::Vec3> positions, const dch::Box& box) {
  const Followed followed = follow(positions, box);
  if (followed != Followed::Unknown) return followed == Followed::Kept;
  const dch::Span<const dch::Vec3> near = broughtNear(positions, box);
  if (expiry->is_stale(near, box, request, *search)) return false;
  pairs.refresh(near, box, &pool);
  return true;
}

const dch::ClusterPairs& ClusterPairKeeper::at(dch::Span<const dch::Vec3> positions, const dch::Box& box,
                                               dch::ClusterPairs::EntryOrder order) {
  chooseSkin(box);
  if (isKept(positions, box)) return pairs;
  expiry->forget();
  search->update(positions, box);  // checks them
  search->cluster_pairs(request, pairs);
  pairs.order_entries(order, &pool);
  ++searchCount;
  labelPairs();
  rememberPlaces(positions, box);
  expiry->remember(positions, box, request);
  return pairs;
}

}  // namespace OpenMMDCH
