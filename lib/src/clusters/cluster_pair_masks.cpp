// SPDX-License-Identifier: MIT
//
// ClusterPairFinder: pairs that masks leave out, by exclusions and types; what it counts.
#include <utility>

#include "clusters/cluster_pair_finder.hpp"

namespace dch::detail {
namespace {

std::size_t first_slot(std::int32_t cluster) { return static_cast<std::size_t>(cluster) * kSlots; }

}  // namespace

/// Calls f(cluster, bit) for each pair of a slot of cluster c with an excluded partner. Padding, which is no
/// particle, has none.
template <class F>
void ClusterPairFinder::for_each_excluded(const Exclusions& exclusions, std::int32_t c,
                                          const ClusterPairs& clusters, const F& f) const {
  for (int slot = 0; slot < kSlots; ++slot) {
    const std::int32_t i = clusters.particle[first_slot(c) + static_cast<std::size_t>(slot)];
    for (const std::int32_t j : exclusions.partners(i)) {
      const std::int32_t other = slot_of_[static_cast<std::size_t>(j)];
      if (other != kNone) f(static_cast<std::size_t>(other / kSlots), 1u << (kSlots * slot + other % kSlots));
    }
  }
}

void ClusterPairFinder::mark_exclusions(const Exclusions& exclusions, std::int32_t c,
                                        const ClusterPairs& clusters, Slice& slice) const {
  for_each_excluded(exclusions, c, clusters, [&](std::size_t other, std::uint32_t bit) {
    slice.excluded[other] = static_cast<std::uint16_t>(slice.excluded[other] | bit);
  });
}

void ClusterPairFinder::unmark_exclusions(const Exclusions& exclusions, std::int32_t c,
                                          const ClusterPairs& clusters, Slice& slice) const {
  for_each_excluded(exclusions, c, clusters,
                    [&](std::size_t other, std::uint32_t) { slice.excluded[other] = 0; });
}

/// Bits of the pairs whose types have a cutoff.
std::uint32_t ClusterPairFinder::pairs_of_wanted_types(const TypeCutoffs& cutoffs, std::int32_t a,
                                                       std::int32_t b, const ClusterPairs& clusters) {
  std::uint32_t mask = 0;
  for (int pair = 0; pair < kSlots * kSlots; ++pair) {
    const std::int32_t type_a = clusters.type[first_slot(a) + static_cast<std::size_t>(pair / kSlots)];
    const std::int32_t type_b = clusters.type[first_slot(b) + static_cast<std::size_t>(pair % kSlots)];
    mask |= static_cast<std::uint32_t>(cutoffs(type_a, type_b) > 0) << pair;
  }
  return mask;
}

/// For the next search. What none reads gives its memory back: 11 bytes a particle.
void ClusterPairFinder::keep_cuts() {
  std::swap(last_cuts_, cuts_);
  clusters_ = {};
}

ClusterPairFinder::Work ClusterPairFinder::work() const {
  Work work;
  for (const Slice& slice : slices_) work += slice.work;
  return work;
}

std::size_t ClusterPairFinder::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t bytes = bytes_of(nodes_) + clusters_.memory_bytes() + bytes_of(ghost_) + bytes_of(slot_of_);
  for (const Cuts* cuts : {&cuts_, &last_cuts_})
    bytes += bytes_of(cuts->of_node) + bytes_of(cuts->id) + bytes_of(cuts->place);
  for (const Slice& slice : slices_)
    bytes += bytes_of(slice.rows) + bytes_of(slice.entries) + bytes_of(slice.shift) +
             slice.near.memory_bytes() + bytes_of(slice.section) + bytes_of(slice.excluded);
  return bytes;
}

}  // namespace dch::detail
