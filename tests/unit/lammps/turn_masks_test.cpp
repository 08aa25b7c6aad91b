// SPDX-License-Identifier: GPL-2.0-or-later
#include "turn_masks.h"

#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace LAMMPS_NS {
namespace {

// In LAMMPS's own words: the owner of i skips ghost j if itag > jtag and their sum is even, or itag < jtag
// and it is odd.
bool is_taken(tagint own, tagint ghost) {
  if (own > ghost) return (own + ghost) % 2 != 0;
  return (own + ghost) % 2 == 0;
}

bool expected(std::int32_t i, std::int32_t j, const std::vector<tagint>& tag, int owned) {
  const bool ghost_i = i >= owned, ghost_j = j >= owned;
  if (ghost_i && ghost_j) return false;
  if (!ghost_i && !ghost_j) return true;
  const tagint a = tag[static_cast<std::size_t>(i)], b = tag[static_cast<std::size_t>(j)];
  return ghost_j ? is_taken(a, b) : is_taken(b, a);
}

TEST(TurnMasks, AreTheRuleOfParityForAllPairsOfTwoClusters) {
  constexpr int kOwned = 6, kAtoms = 12;
  std::mt19937 draw(11);
  for (int round = 0; round < 500; ++round) {
    std::vector<tagint> tag;
    for (int i = 0; i < kAtoms; ++i) tag.push_back(static_cast<tagint>(1 + draw() % 20));
    std::vector<std::int32_t> particle;
    for (int slot = 0; slot < 8; ++slot)
      particle.push_back(static_cast<std::int32_t>(draw() % (kAtoms + 1)) - 1);
    TurnMasks masks;
    masks.assign(particle, tag.data(), kOwned);
    const std::uint16_t mask = masks.mask(0, 1);
    for (int bit = 0; bit < 16; ++bit) {
      const std::int32_t i = particle[static_cast<std::size_t>(bit / 4)],
                         j = particle[static_cast<std::size_t>(4 + bit % 4)];
      if (i < 0 || j < 0) continue;
      const auto pair = static_cast<std::uint16_t>(1 << bit);
      const bool has_ghost = i >= kOwned || j >= kOwned;
      const bool same = tag[static_cast<std::size_t>(i)] == tag[static_cast<std::size_t>(j)];
      if (masks.can_tell(0, 1, pair)) {
        EXPECT_EQ((mask & pair) != 0, expected(i, j, tag, kOwned)) << i << " " << j;
      } else {
        EXPECT_TRUE(same);
      }
      if (has_ghost && same) {
        EXPECT_FALSE(masks.can_tell(0, 1, pair));
      }
    }
  }
}

}  // namespace
}  // namespace LAMMPS_NS
