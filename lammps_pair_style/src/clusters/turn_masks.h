// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/clusters/cluster_pairs.hpp>

namespace LAMMPS_NS {

/// GhostSides::is_taken_here() for all pairs of two clusters at once, of which no pair is of two ghosts.
class TurnMasks {
 public:
  /// @param particle of cluster pairs: an atom for each slot, -1 where there is none
  /// @param is_taken_here called with an atom: whether pairs with it are taken here
  template <class Test>
  void assign(const std::vector<std::int32_t>& particle, const Test& is_taken_here) {
    of_others_.assign(particle.size() / kSlots, 0);
    for (std::size_t slot = 0; slot < particle.size(); ++slot) {
      if (particle[slot] < 0 || is_taken_here(particle[slot])) continue;
      of_others_[slot / kSlots] = static_cast<std::uint8_t>(of_others_[slot / kSlots] | 1u << slot % kSlots);
    }
  }

  /// Bit 4 a + b: whether this process takes the pair of slot a of one cluster and slot b of the other.
  std::uint16_t mask(std::int32_t row, std::int32_t column) const {
    return static_cast<std::uint16_t>(~(kRows[at(row)] | at(column) * 0x1111u));
  }

 private:
  static constexpr std::size_t kSlots = dch::ClusterPairs::kSlots;
  static_assert(kSlots == 4, "masks have a bit for each pair of four and four");
  /// By the slots of a row's cluster, the bits of their pairs.
  static constexpr std::array<std::uint16_t, 16> kRows{0x0000, 0x000f, 0x00f0, 0x00ff, 0x0f00, 0x0f0f,
                                                       0x0ff0, 0x0fff, 0xf000, 0xf00f, 0xf0f0, 0xf0ff,
                                                       0xff00, 0xff0f, 0xfff0, 0xffff};

  unsigned at(std::int32_t cluster) const { return of_others_[static_cast<std::size_t>(cluster)]; }

  std::vector<std::uint8_t> of_others_;  ///< by cluster, a bit for each slot
};

}  // namespace LAMMPS_NS
