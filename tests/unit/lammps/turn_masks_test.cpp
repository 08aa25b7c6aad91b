// SPDX-License-Identifier: GPL-2.0-or-later
#include "turn_masks.h"

#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace LAMMPS_NS {
namespace {

TEST(TurnMasks, LeaveOutThePairsOfOthers) {
  constexpr int kAtoms = 12;
  std::mt19937 draw(11);
  for (int round = 0; round < 500; ++round) {
    std::vector<bool> is_taken;
    for (int i = 0; i < kAtoms; ++i) is_taken.push_back(draw() % 3 != 0);
    std::vector<std::int32_t> particle;
    for (int slot = 0; slot < 8; ++slot)
      particle.push_back(static_cast<std::int32_t>(draw() % (kAtoms + 1)) - 1);
    TurnMasks masks;
    masks.assign(particle, [&](std::int32_t i) { return is_taken[static_cast<std::size_t>(i)]; });
    const std::uint16_t mask = masks.mask(0, 1);
    for (int bit = 0; bit < 16; ++bit) {
      const std::int32_t i = particle[static_cast<std::size_t>(bit / 4)],
                         j = particle[static_cast<std::size_t>(4 + bit % 4)];
      if (i < 0 || j < 0) continue;
      const bool is_expected = is_taken[static_cast<std::size_t>(i)] && is_taken[static_cast<std::size_t>(j)];
      EXPECT_EQ((mask >> bit & 1) != 0, is_expected) << i << " " << j;
    }
  }
}

}  // namespace
}  // namespace LAMMPS_NS
