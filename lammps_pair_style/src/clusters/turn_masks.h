// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <lammps_host.h>
#include <lmptype.h>
#include <vector>

#include <dch/clusters/cluster_pairs.hpp>

#include "pair_rules.h"

namespace LAMMPS_NS {

/// PairRules::stored_here() for all pairs of two clusters at once, where it goes by parity: a process takes
/// pairs of owned atoms, none of two ghosts, and of the others those that the IDs give to the owned one.
class TurnMasks {
 public:
  /// @param particle of cluster pairs: an atom for each slot, -1 where there is none
  /// @param owned atoms below this index are owned, the others are ghosts
  void assign(const std::vector<std::int32_t>& particle, const tagint* tag, int owned) {
    clusters_.resize(particle.size() / kSlots);
    for (std::size_t slot = 0; slot < particle.size(); ++slot) {
      Cluster& cluster = clusters_[slot / kSlots];
      if (slot % kSlots == 0) cluster.ghosts = 0;
      const std::int32_t atom = particle[slot];
      cluster.tag[slot % kSlots] = atom < 0 ? 0 : tag[atom];
      if (atom >= owned) cluster.ghosts |= 1u << slot % kSlots;
    }
  }

  /// Whether the mask is right for these pairs: it is not for an owned atom and its own image.
  bool can_tell(std::int32_t row, std::int32_t column, std::uint16_t pairs) const {
    const Cluster &a = at(row), &b = at(column);
    if ((a.ghosts | b.ghosts) == 0) return true;
    const std::uint32_t same = bits(a, b, [](Four first, Four second) { return first == second; });
    return (same & pairs) == 0;
  }

  /// Bit 4 a + b: whether this process takes the pair of slot a of one cluster and slot b of the other.
  std::uint16_t mask(std::int32_t row, std::int32_t column) const {
    const Cluster &a = at(row), &b = at(column);
    if ((a.ghosts | b.ghosts) == 0) return 0xffff;
    // PairRules::goes_to_first()
    const std::uint32_t to_first = bits(a, b, [](Four first, Four second) {
      const Four odd = -((first ^ second) & 1);
      return (first > second) == odd;
    });
    const std::uint32_t row_ghosts = kRows[a.ghosts], column_ghosts = b.ghosts * 0x1111u;
    const std::uint32_t of_ghosts = (column_ghosts & to_first) ^ (row_ghosts & ~to_first);
    return static_cast<std::uint16_t>((~row_ghosts & ~column_ghosts) |
                                      ((row_ghosts ^ column_ghosts) & of_ghosts));
  }

 private:
  static constexpr std::size_t kSlots = dch::ClusterPairs::kSlots;
  static_assert(kSlots == 4, "masks have a bit for each pair of four and four");
  /// By the slots of a row's cluster, the bits of their pairs.
  static constexpr std::array<std::uint16_t, 16> kRows{0x0000, 0x000f, 0x00f0, 0x00ff, 0x0f00, 0x0f0f,
                                                       0x0ff0, 0x0fff, 0xf000, 0xf00f, 0xf0f0, 0xf0ff,
                                                       0xff00, 0xff0f, 0xfff0, 0xffff};

  /// Four integers as one, in comparisons -1 for true: compilers make no vectors of loops over pairs of
  /// slots.
  using Four = std::int32_t __attribute__((vector_size(16)));

  struct Cluster {
    Four tag;
    std::uint32_t ghosts;  ///< a bit for each slot
  };

  /// Bit 4 a + b: what `test` says of the IDs in slot a of one cluster and in slot b of the other.
  template <class Test>
  static std::uint32_t bits(const Cluster& a, const Cluster& b, const Test& test) {
    Four sum{0, 0, 0, 0}, bit{1, 2, 4, 8};
    for (std::size_t slot = 0; slot < kSlots; ++slot) {
      const std::int32_t tag = a.tag[slot];
      sum |= test(Four{tag, tag, tag, tag}, b.tag) & bit;
      bit <<= 4;
    }
    return static_cast<std::uint32_t>(sum[0] | sum[1] | sum[2] | sum[3]);
  }
  const Cluster& at(std::int32_t cluster) const { return clusters_[static_cast<std::size_t>(cluster)]; }

  std::vector<Cluster> clusters_;
};

}  // namespace LAMMPS_NS
