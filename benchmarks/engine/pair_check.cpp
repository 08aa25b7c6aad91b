// SPDX-License-Identifier: MIT
#include "pair_check.hpp"

#include <algorithm>

#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

namespace dch::bench {
namespace {

constexpr std::size_t kFew = 5000;

/// Finalizer of SplitMix64: spreads neighboring numbers over all 64 bits.
std::uint64_t mixed(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9u;
  v = (v ^ (v >> 27)) * 0x94D049BB133111EBu;
  return v ^ (v >> 31);
}

/// Largest distance at which the scene lists a pair.
double reach_of(const Scene& scene, std::size_t which, std::int32_t i, std::int32_t j) {
  if (scene.radii.empty()) return scene.list_radii[which];
  const auto a = static_cast<std::size_t>(std::min(i, j)), b = static_cast<std::size_t>(std::max(i, j));
  return scene.radii[a] + scene.radii[b] + scene.skin;
}

bool is_within(const Scene& scene, std::size_t which, std::int32_t i, std::int32_t j) {
  const auto a = static_cast<std::size_t>(std::min(i, j)), b = static_cast<std::size_t>(std::max(i, j));
  const double reach = reach_of(scene, which, i, j);
  return scene.box.distance2(scene.positions[a], scene.positions[b]) <= reach * reach;
}

/// Calls visit(i, j) for all pairs of a list.
template <class Visit>
void for_pairs(const NeighborList& list, const Visit& visit) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::int32_t i = list.particle.empty() ? static_cast<std::int32_t>(k) : list.particle[k];
    for (const std::int32_t j : list.row(k)) visit(i, j);
  }
}

/// Each particle with all smaller or equal ones: larger ones against all others, one by one, and those up to
/// twice the smallest radius by cells.
PairSum pairs_by_radii(const Scene& scene) {
  const std::vector<double>& radii = scene.radii;
  const double limit = 2 * *std::min_element(radii.begin(), radii.end());
  const auto count = static_cast<std::int32_t>(radii.size());
  const auto in_contact = [&](std::int32_t i, std::int32_t j) { return is_within(scene, 0, i, j); };
  PairSum sum;
  std::vector<std::int32_t> small;
  std::vector<Vec3> small_positions;
  for (std::int32_t i = 0; i < count; ++i) {
    const double radius = radii[static_cast<std::size_t>(i)];
    if (radius <= limit) {
      small.push_back(i);
      small_positions.push_back(scene.positions[static_cast<std::size_t>(i)]);
      continue;
    }
    for (std::int32_t j = 0; j < count; ++j)
      if (j != i && (radii[static_cast<std::size_t>(j)] <= limit || j < i) && in_contact(i, j)) sum.add(i, j);
  }
  const double reach = 2 * limit + scene.skin;
  const auto cells = make_cell_search(reach);
  cells->update(small_positions, scene.box);
  ListParams params;
  params.cutoffs = TypeCutoffs(reach);
  const NeighborList near = cells->list(params);
  for (std::size_t k = 0; k < near.size(); ++k)
    for (const std::int32_t other : near.row(k)) {
      const std::int32_t i = small[k], j = small[static_cast<std::size_t>(other)];
      if (in_contact(i, j)) sum.add(i, j);
    }
  return sum;
}

}  // namespace

void PairSum::add(std::int32_t i, std::int32_t j) {
  const auto low = static_cast<std::uint64_t>(std::min(i, j)),
             high = static_cast<std::uint64_t>(std::max(i, j));
  ++pairs;
  hash += mixed(low << 32 | high);
}

PairSum sum_of(const NeighborList& list) {
  PairSum sum;
  for_pairs(list, [&](std::int32_t i, std::int32_t j) { sum.add(i, j); });
  return sum;
}

PairSum sum_within(const NeighborList& list, const Scene& scene, std::size_t which) {
  PairSum sum;
  for_pairs(list, [&](std::int32_t i, std::int32_t j) {
    if (is_within(scene, which, i, j)) sum.add(i, j);
  });
  return sum;
}

PairSum expected_pairs(const Scene& scene, std::size_t which) {
  if (!scene.radii.empty()) return pairs_by_radii(scene);
  ListParams params;
  params.cutoffs = TypeCutoffs(scene.list_radii[which]);
  params.exclusions = &scene.exclusions;
  if (scene.positions.size() <= kFew) return sum_of(all_pairs(scene.positions, scene.box, params));
  const auto cells = make_cell_search(scene.list_radii[which]);
  cells->update(scene.positions, scene.box);
  return sum_of(cells->list(params));
}

}  // namespace dch::bench
