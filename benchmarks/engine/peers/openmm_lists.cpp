// SPDX-License-Identifier: MIT
#include "openmm_lists.hpp"

namespace dch::bench {

OpenMmLists::OpenMmLists(const Scene& scene)
    : atoms_(static_cast<int>(scene.positions.size())),
      radius_(static_cast<float>(scene.list_radii.back())),
      positions_(4 * atoms_),
      exclusions_(scene.positions.size()) {
  if (scene.exclusions.empty()) return;
  for (int i = 0; i < atoms_; ++i) {
    const auto partners = scene.exclusions.partners(i);
    exclusions_[static_cast<std::size_t>(i)].insert(partners.begin(), partners.end());
  }
}

void OpenMmLists::take(const Scene& scene) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 v = scene.box.vector(axis);
    box_[axis] = OpenMM::Vec3(v.x, v.y, v.z);
  }
  for (int i = 0; i < atoms_; ++i) {
    const Vec3 p = scene.box.wrap(scene.positions[static_cast<std::size_t>(i)]);
    for (int axis = 0; axis < 3; ++axis) positions_[4 * i + axis] = static_cast<float>(p[axis]);
    positions_[4 * i + 3] = 0;
  }
}

void OpenMmLists::make() {
  list_.computeNeighborList(atoms_, positions_, exclusions_, box_, true, radius_, threads_);
}

/// Visits all pairs that the list holds.
template <class Visit>
void OpenMmLists::for_pairs(const Visit& visit) const {
  const auto& order = list_.getSortedAtoms();
  for (int block = 0; block < list_.getNumBlocks(); ++block) {
    const auto& neighbors = list_.getBlockNeighbors(block);
    const auto& excluded = list_.getBlockExclusions(block);
    for (std::size_t k = 0; k < neighbors.size(); ++k)
      for (int lane = 0; lane < kBlockSize; ++lane) {
        const auto place = static_cast<std::size_t>(block * kBlockSize + lane);
        if (place < order.size() && (excluded[k] >> lane & 1) == 0) visit(order[place], neighbors[k]);
      }
  }
}

PairSum OpenMmLists::pairs_within(const Scene& scene) const {
  const double radius = scene.list_radii.back();
  PairSum sum;
  for_pairs([&](int a, int b) {
    const auto i = static_cast<std::size_t>(std::min(a, b)), j = static_cast<std::size_t>(std::max(a, b));
    if (scene.box.distance2(scene.positions[i], scene.positions[j]) <= radius * radius) sum.add(a, b);
  });
  return sum;
}

std::int64_t OpenMmLists::pairs_held() const {
  std::int64_t pairs = 0;
  for_pairs([&](int, int) { ++pairs; });
  return pairs;
}

}  // namespace dch::bench
