// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <lammps_host.h>
#include <memory>
#include <vector>

#include <dch/engines/pair_search.hpp>

#include "moving_bonds.h"

namespace LAMMPS_NS {

/// Two bonds that went through each other.
struct BondCrossing {
  std::array<tagint, 4> tags{};  ///< of the atoms of the first bond, ascending, then of the second
  double time = 0;               ///< from 0, the last check, to 1
  dch::Vec3 place;
  int sign = 0;  ///< for bonds from their atom of smaller ID to the other
};

/// Counts of pairs of bonds. A pair is that of the process that holds the bond with the smaller IDs.
struct PairCounts {
  bigint near = 0;      ///< whose balls meet, and which have no common atom
  bigint rejected = 0;  ///< of these, kept apart by the zonotope
  bigint contacts = 0;
};

/// Finds the pairs of bonds that went through each other, among those that a process holds and those that its
/// ghosts do.
///
/// Broad phase: pairs of middles within a reach that stays the same from call to call while it suffices, by a
/// search that is kept. Then balls, two separating axes of the zonotope in which the difference of two
/// points, one of each bond and at the same time, lies (the line of the middles, the normal of both bonds),
/// in single precision with a margin for its rounding; then the exact test.
class CrossingFinder {
 public:
  /// @param box of the middles; without periodic vectors where ghosts stand for images
  void find(const MovingBonds& bonds, const dch::Box& box, const dch::lammps::Cell& cell, double thickness);

  const std::vector<BondCrossing>& crossings() const { return crossings_; }
  const PairCounts& counts() const { return counts_; }
  double memory_bytes() const;

 private:
  void take(const dch::NeighborList& piece);
  bool is_mine(std::size_t i, std::size_t j) const;
  bool balls_meet(std::size_t i, std::size_t j, dch::Vec3 between) const;
  bool kept_apart(std::size_t i, std::size_t j, dch::Vec3 between) const;
  void test(std::size_t i, std::size_t j, dch::Vec3 between);

  const MovingBonds* bonds_ = nullptr;
  const dch::Box* box_ = nullptr;
  const dch::lammps::Cell* cell_ = nullptr;
  double thickness_ = 0;
  float slack_ = 0;  ///< for rounding in products of single precision [length]
  std::unique_ptr<dch::PairSearch> search_;
  double radius_ = 0;  ///< that search_ was made for
  std::vector<BondCrossing> crossings_;
  PairCounts counts_;
};

}  // namespace LAMMPS_NS
