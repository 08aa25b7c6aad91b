// SPDX-License-Identifier: GPL-2.0-or-later
#include "ghost_sides.h"

#include <array>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

namespace LAMMPS_NS {
namespace {

using Vectors = std::array<int, 3>;

constexpr int kLastRank = std::numeric_limits<int>::max();

Vectors opposite(const Vectors& n) { return {-n[0], -n[1], -n[2]}; }

/// How many of the two processes of a pair take it: that of rank `first`, whose ghost is the other's atom by
/// so many box vectors off, and the other one, which sees the same vectors the other way round.
int sides_of(int first, int second, const Vectors& n) {
  const bool by_first = is_taken_by(first, shifted(second, n.data()));
  const bool by_second = is_taken_by(second, shifted(first, opposite(n).data()));
  return (by_first ? 1 : 0) + (by_second ? 1 : 0);
}

/// Few box vectors or many, of all axes or some.
Vectors draw_vectors(std::mt19937& draw) {
  const int most = std::uniform_int_distribution<int>(0, 1)(draw) == 0 ? 2 : 500;
  std::uniform_int_distribution<int> number(-most, most);
  Vectors n{number(draw), number(draw), number(draw)};
  for (int& k : n)
    if (std::uniform_int_distribution<int>(0, 2)(draw) == 0) k = 0;
  return n;
}

int draw_rank(std::mt19937& draw) {
  const int most = std::uniform_int_distribution<int>(0, 1)(draw) == 0 ? 3 : kLastRank;
  return std::uniform_int_distribution<int>(0, most)(draw);
}

TEST(GhostSides, OneOfTwoProcessesTakesAPair) {
  std::mt19937 draw(11);
  int with_itself = 0, in_same_box = 0;
  for (int k = 0; k < 200000; ++k) {
    const int first = draw_rank(draw), second = draw_rank(draw);
    const Vectors n = draw_vectors(draw);
    const bool is_here = n == Vectors{0, 0, 0};
    if (is_here && first == second) continue;  // no ghost
    with_itself += first == second ? 1 : 0;
    in_same_box += is_here ? 1 : 0;
    ASSERT_EQ(sides_of(first, second, n), 1)
        << first << " and " << second << ", " << n[0] << ' ' << n[1] << ' ' << n[2];
  }
  EXPECT_GT(with_itself, 10000);
  EXPECT_GT(in_same_box, 1000);
}

TEST(GhostSides, TheUpperHalfOfTheLatticeIsTakenThenThatOfHigherRanks) {
  const std::vector<Vectors> upper{{0, 0, 1},  {1, 0, 0},    {0, 1, 0},       {-500, 0, 1},
                                   {0, -1, 1}, {-500, 1, 0}, {-500, -500, 1}, {500, -500, 1}};
  for (const Vectors& n : upper)
    for (const int own : {0, 1, kLastRank})
      for (const int other : {0, 1, kLastRank}) {
        EXPECT_TRUE(is_taken_by(own, shifted(other, n.data())));
        EXPECT_FALSE(is_taken_by(own, shifted(other, opposite(n).data())));
      }
  EXPECT_TRUE(is_taken_by(0, 1));
  EXPECT_FALSE(is_taken_by(1, 0));
  EXPECT_TRUE(is_taken_by(kLastRank - 1, kLastRank));
  EXPECT_TRUE(is_taken_by(7, 7)) << "pairs of owned atoms";
}

TEST(GhostSides, VectorsOfGhostsOfGhostsAddUp) {
  std::mt19937 draw(12);
  for (int k = 0; k < 1000; ++k) {
    const int rank = draw_rank(draw);
    const Vectors n = draw_vectors(draw);
    ImageOfAtom image = rank;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vectors step{0, 0, 0};
      step[axis] = n[axis] > 0 ? 1 : -1;
      for (int hop = 0; hop < std::abs(n[axis]); ++hop) image = shifted(image, step.data());
    }
    EXPECT_EQ(image, shifted(rank, n.data()));
  }
}

}  // namespace
}  // namespace LAMMPS_NS
